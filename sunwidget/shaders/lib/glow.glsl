// Veiling glare of the camera: what its lens scatters of the sun's light over the whole picture,
// land and sky. As in the eye it falls off with the angle squared (Stiles & Holladay; Vos 2003, "On
// the cause of disability glare", eq. 2: L/E = 10 / angle^3 + 5 / angle^2), but a lens scatters less.

#include "lib/camera_glare.glsl"

// Degrees squared per steradian: a tenth of the eye's. Of the light that falls on the lens 0.35 %
// then veil the picture out to 30 degrees, which is what good lenses do.
const float kLensScatter = 0.5;
// Nearer to the sun the glow is flat: there its disc has burnt everything anyway.
const float kGlowCore = 1.0;  // degrees

// Luminance, for a sun of luminance `light` on the lens. Where the photo's own sun told how its
// lens glows (`measured`, of lib/camera_glare.glsl), the land gets no less than the sky has there.
float GetGlow(float degrees_from_sun, float light, float measured) {
  float plain = kLensScatter * light / (degrees_from_sun * degrees_from_sun + kGlowCore * kGlowCore);
  return max(plain, measured);
}
