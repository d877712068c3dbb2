// The last step of every method: photo plus change, dithered, in the wanted transfer function.

#include "frame/pixel.glsl"

uniform float output_levels;  // of the target, where it holds whole levels; 0 where it holds floats

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
  // Drivers round each in its own way.
  if (output_levels > 0.0) code = floor(clamp(code, 0.0, 1.0) * output_levels + 0.5) / output_levels;
  result = vec4(code, 1.0);
}
