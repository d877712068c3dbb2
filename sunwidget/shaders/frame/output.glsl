// The last step of every method: photo plus change, dithered, in the requested transfer function.

#include "frame/pixel.glsl"

uniform float output_levels;  // largest code value of an integer target, 0 for a float target

void WriteFrame(vec3 photo_light, vec3 change, vec2 pixel) {
  vec3 light = photo_light + change;
  if (output_transfer == 0) {
    result = vec4(light, 1.0);
    return;
  }
  vec3 code = EncodeSrgb(light);
  // Unchanged pixels keep their own code values.
  float touched = step(1e-6, max(abs(change.r), max(abs(change.g), abs(change.b))));
  code += touched * GetDither(pixel);
  // Drivers differ in rounding, so round here.
  if (output_levels > 0.0) code = floor(clamp(code, 0.0, 1.0) * output_levels + 0.5) / output_levels;
  result = vec4(code, 1.0);
}
