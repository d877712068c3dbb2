// The photo's own noise where the frame fills in parts that the photo does not show (analysis/images/noise.py):
// the same at each pixel in every frame, so that it does not swim while the sun is dragged.

#include "frame/pixel.glsl"

uniform float grain;         // strength, 0 = exactly off
uniform float noise_level;   // deviation of the photo's encoded luminance at its own size
uniform float photo_height;  // pixels: a smaller frame averages the noise

// The noise to add to display-linear `light`. `filled` is the share of the photo, with its noise, that
// was replaced. Where the frame is darker than the photo (`before`), its noise is weaker, too.
vec3 GetGrain(vec3 light, vec3 before, float filled, vec2 pixel) {
  if (filled == 0.0) return vec3(0.0);
  uvec2 at = uvec2(pixel);
  float kept = 1.0 - filled;
  float level = GetLuminance(light) / max(GetLuminance(before), 1e-4);
  float deviation = grain * noise_level * min(frame_size.y / max(photo_height, 1.0), 1.0)
      * sqrt(max(1.0 - kept * kept, 0.0)) * pow(clamp(level, 0.0, 1.0), 1.0 / 2.2);
  // Luminance is noisier than color. Triangular noise has a deviation of 0.41.
  float shared_noise = GetNoise(at, 11u) - GetNoise(at, 12u);
  vec3 own = vec3(GetNoise(at, 13u), GetNoise(at, 14u), GetNoise(at, 15u)) - GetNoise(at, 16u);
  vec3 code = deviation / 0.41 * (0.9 * shared_noise + 0.4 * own);
  // Slope of the transfer from code to light; no grain in clipped parts.
  vec3 slope = 2.2 * pow(max(light, vec3(1e-4)), vec3(1.2 / 2.2));
  return code * slope * (1.0 - smoothstep(0.9, 1.0, max(light.r, max(light.g, light.b))));
}
