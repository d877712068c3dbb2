// The air round a sun that a thick cloud hides (`sun_visibility`): what lies in the cloud's shadow
// loses the aureole, the peak of the haze's forward scattering, and keeps the rest.

#include "atmosphere/atmosphere.glsl"

uniform float sun_visibility;  // share of the direct light that comes through

const float kShadedAsymmetry = 0.4;  // of haze that is lit from all around
const float kBeyondAureole = 0.707;  // cosine of the angle from the sun where nothing changes

float GetShadedAsymmetry() {
  return mix(min(aerosol_asymmetry, kShadedAsymmetry), aerosol_asymmetry, sun_visibility);
}

// What the haze's light is scaled by, so that it is the same 45 degrees from the sun.
float GetShadedShare() {
  return sun_visibility == 1.0 ? 1.0
      : MiePhase(aerosol_asymmetry, kBeyondAureole) / MiePhase(GetShadedAsymmetry(), kBeyondAureole);
}
