// The last step of every method: photo plus change, dithered, in the wanted transfer function.

#include "lib/pixel.glsl"

void WriteFrame(vec3 photo_light, vec3 change, vec2 pixel) {
  vec3 light = photo_light + change;
  if (output_transfer == 0) {
    result = vec4(light, 1.0);
    return;
  }
  vec3 code = EncodeSrgb(light);
  // Unchanged pixels keep their own code values.
  float touched = step(1e-6, max(abs(change.r), max(abs(change.g), abs(change.b))));
  result = vec4(code + touched * GetDither(pixel), 1.0);
}
