// The photo with a change of its scene-linear light.

#include "lib/response.glsl"
#include "lib/output.glsl"

// Written as a difference, so that what did not change adds exactly nothing.
void WriteChange(vec3 display, vec3 scene, vec3 change, vec2 pixel) {
  float touched = step(1e-30, dot(abs(change), vec3(1.0)));
  vec3 representable = clamp(display, vec3(0.0), vec3(GetWhiteLevel()));
  WriteFrame(display, touched * (GetDisplayLight(scene + change) - representable), pixel);
}
