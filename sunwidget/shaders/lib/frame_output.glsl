// The photo with a change of its scene-linear light.

#include "lib/response.glsl"
#include "lib/output.glsl"
#include "lib/grain.glsl"

// Written as a difference, so that what did not change adds exactly nothing. What was `filled`
// gets the photo's noise (lib/grain.glsl).
void WriteChange(vec3 display, vec3 scene, vec3 change, float filled, vec2 pixel) {
  float touched = step(1e-30, dot(abs(change), vec3(1.0)));
  vec3 representable = clamp(display, vec3(0.0), vec3(GetWhiteLevel()));
  vec3 light = GetDisplayLight(scene + change);
  light += GetGrain(light, filled, pixel);
  WriteFrame(display, touched * (light - representable), pixel);
}
