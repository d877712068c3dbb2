// How moonlight is seen: by the rods, without color, blind to red (Purkinje 1825). Photos of
// moonlit nights are printed so, and so a person takes a dark picture for a night.

#include "sky/moonlight.glsl"

// Not all of it: pictures of nights keep some color.
const float kRods = 0.7;
// Rods' response to linear Rec. 709: V' = -0.702 X + 1.039 Y + 0.433 Z (Pattanaik et al. 1998,
// "A multiscale model of adaptation", SIGGRAPH, sec. 4.1), white at one.
const vec3 kRodResponse = vec3(-0.071, 0.6443, 0.4267);
// What rods see looks bluish: chromaticity (0.25, 0.25), luminance one (Jensen et al. 2000, "Night
// rendering", UUCS-00-016, sec. 5).
const vec3 kRodColor = vec3(0.706, 0.990, 1.966);

// 1 where the picture's light is a moon's and the photo's was the sun's: a photo that was taken
// by moonlight has its colors from its camera.
float GetNight() {
  return max(GetMoon() - photo_light, 0.0);
}

// What night vision adds to `light` (and takes from it).
vec3 GetRodShift(vec3 light) {
  return kRods * (kRodColor * max(dot(light, kRodResponse), 0.0) - light);
}
