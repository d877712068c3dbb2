// Named access to the values that all pixels of the frame share (composite_constants.glsl), passed on by
// frame_constants.glsl. Values that few pixels need are read from the map itself.

#include "frame/composite_texels.glsl"

flat in vec4 composite[11];
uniform sampler2D composite_constants;

// Exposure of the picture, as a factor.
float GetExposureGain() {
  return composite[kGains].x;
}

// How far the sun has moved, 0 to 1.
float GetMoved() {
  return composite[kGains].y;
}

// Share of its color that land loses in shade.
float GetColorLoss() {
  return composite[kGains].z;
}

// Exposure of the land relative to the picture's, as a factor.
float GetLandGain() {
  return abs(composite[kGains].w);
}

// Whether the light that the sky sends in all directions is the same to the bit.
bool IsSkyUnchanged() {
  return composite[kGains].w < 0.0;
}

vec3 GetSunBefore() {
  return composite[kSunBefore].rgb;
}

// Light of a cloud: `Ambient` from the sky and the shaded side, `Lobe` the contribution of its forward lobe.
vec3 GetCloudAmbientBefore() {
  return composite[kCloudBefore].rgb - composite[kCloudLobeBefore].rgb;
}

vec3 GetCloudLobeBefore() {
  return composite[kCloudLobeBefore].rgb;
}

vec3 GetCloudAmbientNow() {
  return composite[kCloudNow].rgb - composite[kCloudLobeNow].rgb;
}

vec3 GetCloudLobeNow() {
  return composite[kCloudLobeNow].rgb;
}

// Irradiance of land, from level (`upright` = 0) to upright (1).
vec3 GetIrradianceBefore(float upright) {
  return mix(composite[kLevelLandBefore].rgb, composite[kUprightLandBefore].rgb, upright);
}

vec3 GetIrradianceNow(float upright) {
  return mix(composite[kLevelLandNow].rgb, composite[kUprightLandNow].rgb, upright);
}
