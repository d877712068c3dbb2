// The air around a sun hidden by a thick cloud (`sun_visibility`): air in the cloud's shadow
// loses the aureole, the peak of the haze's forward scattering, and keeps the rest.

#include "atmosphere/atmosphere.glsl"

uniform float sun_visibility;  // transmitted share of the direct light

const float kShadedAsymmetry = 0.4;  // of haze lit from all around
const float kBeyondAureole = 0.707;  // cosine of the angle from the sun at which nothing changes

float GetShadedAsymmetry() {
  return mix(min(aerosol_asymmetry, kShadedAsymmetry), aerosol_asymmetry, sun_visibility);
}

// Factor on the haze's light that keeps it unchanged 45 degrees from the sun.
float GetShadedShare() {
  return sun_visibility == 1.0 ? 1.0
      : MiePhase(aerosol_asymmetry, kBeyondAureole) / MiePhase(GetShadedAsymmetry(), kBeyondAureole);
}
