// How the eye sees moonlight: with its rods, without color, blind to red (Purkinje 1825). Photos of
// moonlit nights are printed this way, and it makes a dark picture look like night.

#include "sky/moonlight.glsl"

// Less than one: pictures of nights keep some color.
const float kRods = 0.7;
// Rods' response to linear Rec. 709: V' = -0.702 X + 1.039 Y + 0.433 Z (Pattanaik et al. 1998,
// "A multiscale model of adaptation", SIGGRAPH, sec. 4.1), white at one.
const vec3 kRodResponse = vec3(-0.071, 0.6443, 0.4267);
// Rod vision looks bluish: chromaticity (0.25, 0.25), luminance one (Jensen et al. 2000, "Night
// rendering", UUCS-00-016, sec. 5).
const vec3 kRodColor = vec3(0.706, 0.990, 1.966);

// 1 if the moon lights the picture and the sun lit the photo: a photo taken by moonlight already
// has its camera's colors.
float GetNight() {
  return max(GetMoon() - photo_light, 0.0);
}

// The (signed) change of `light` by night vision.
vec3 GetRodShift(vec3 light) {
  return kRods * (kRodColor * max(dot(light, kRodResponse), 0.0) - light);
}
