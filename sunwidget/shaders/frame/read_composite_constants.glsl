// What all pixels of the frame share (composite_constants.glsl), by name, by way of frame_constants.glsl. What few pixels
// need is read from the map itself.

#include "frame/composite_texels.glsl"

flat in vec4 composite[11];
uniform sampler2D composite_constants;

// Of the picture, as a factor.
float GetExposureGain() {
  return composite[kGains].x;
}

// How far the sun has moved, 0 to 1.
float GetMoved() {
  return composite[kGains].y;
}

// Share of its color that the land loses in the shade.
float GetLostColor() {
  return composite[kGains].z;
}

// Of the land over the picture's exposure, as a factor.
float GetLandGain() {
  return abs(composite[kGains].w);
}

// The light that a sky sends in all directions is the same to the bit.
bool IsSkyAsItWas() {
  return composite[kGains].w < 0.0;
}

vec3 GetSunBefore() {
  return composite[kSunBefore].rgb;
}

// Light of a cloud: `Ambient` from the sky and the shaded side, `Lobe` what its forward lobe adds.
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

// Irradiance of land that is `upright` or lies.
vec3 GetLitBefore(float upright) {
  return mix(composite[kLyingBefore].rgb, composite[kUprightBefore].rgb, upright);
}

vec3 GetLitNow(float upright) {
  return mix(composite[kLyingNow].rgb, composite[kUprightNow].rgb, upright);
}
