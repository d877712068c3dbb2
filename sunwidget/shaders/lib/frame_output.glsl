// The photo with a change of its scene-linear light.

#include "lib/response.glsl"
#include "lib/output.glsl"
#include "lib/grain.glsl"

// From here on highlights roll off: display-linear.
const float kKnee = 0.5;
const float kBurns = 1.06;  // of the way to white, at infinity: the sun itself burns

// Display-linear light of `scene` as a good camera draws highlights: the colour keeps its hue on the way to
// white (each channel for itself would end in cyan, yellow and magenta), and what is `brighter` than it was,
// 0 to 1, leaves the response at the knee and nears white slowly, without a flat plate.
vec3 GetRolledOff(vec3 scene, float brighter) {
  float w = max(response_shoulder, 1e-4);
  float luminance = max(GetLuminance(scene), 1e-9);
  float r = pow(luminance, response_contrast);
  float knee = -log(1.0 - w * kKnee) / w;
  float over = (1.0 - w * kKnee) / (1.0 - kKnee) * max(r - knee, 0.0);
  float level = (1.0 - exp(-w * r)) / w;
  level += brighter * (kKnee + (1.0 - kKnee) * kBurns * over / (1.0 + over) - level) * step(knee, r);
  level = min(level, 0.9999);
  vec3 color = scene / luminance - 1.0;
  float x = max(color.r, max(color.g, color.b)) * level / (1.0 - level);
  return level + level * inversesqrt(1.0 + x * x) * color;
}

// Written as a difference, so that what did not change adds exactly nothing. What was `filled`
// gets the photo's noise (lib/grain.glsl).
void WriteChange(vec3 display, vec3 scene, vec3 change, float filled, vec2 pixel) {
  float touched = step(1e-30, dot(abs(change), vec3(1.0)));
  vec3 representable = clamp(display, vec3(0.0), vec3(GetWhiteLevel()));
  vec3 now = scene + change;
  vec3 light = GetDisplayLight(now);
  float old = GetLuminance(scene) / max(GetLuminance(now), 1e-9);
  vec3 changed = abs(change) / max(now, scene);
  float most = max(changed.r, max(changed.g, changed.b));
  float rolls = most * most / (most * most + 0.01) * smoothstep(0.4, 0.8, max(light.r, max(light.g, light.b)));
  light += rolls * (GetRolledOff(now, max(1.0 - old * old, 0.0)) - light);
  light += GetGrain(light, filled, pixel);
  WriteFrame(display, touched * (light - representable), pixel);
}
