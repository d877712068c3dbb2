// First order of the precomputed sky: sunlight scattered once, or reflected by the ground, in each
// direction of the quadrature (bruneton/field.glsl, "incident"). The source of the second order is
// computed from it.

#include "bruneton/field.glsl"
#include "bruneton/single.glsl"

out vec4 result;

const int kLobeSamples = 3;

// Mean of the aerosol's phase function over the cell of directions that a node represents: a
// node that a narrow lobe falls on would else count it for the whole cell.
Number GetMeanMiePhase(int zenith, int azimuth, Number mu_s) {
  float side = zenith < 8 ? 1.0 : -1.0;
  int node = zenith % 8;
  float level = sqrt(1.0 - mu_s * mu_s);
  float sum = 0.0;
  for (int i = 0; i < kLobeSamples; ++i) {
    float part = (float(i) + 0.5) / float(kLobeSamples);
    float mu = side * mix(kFieldEdges[node], kFieldEdges[node + 1], part);
    float across = sqrt(1.0 - mu * mu) * level;
    for (int k = 0; k < kLobeSamples; ++k) {
      float turn = float(azimuth) + (float(k) + 0.5) / float(kLobeSamples);
      sum += MiePhase(aerosol_asymmetry,
                      mu * mu_s + across * cos(kPi * turn / float(kFieldAzimuths)));
    }
  }
  return sum / float(kLobeSamples * kLobeSamples);
}

void main() {
  IncidentRay ray = GetIncidentRay(ivec2(gl_FragCoord.xy));
  SingleScattering single = ComputeSingleScattering(ray.h, ray.mu, ray.mu_s, ray.nu, ray.d);
  vec4 radiance = single.air * RayleighPhase(ray.nu)
      + single.haze * GetMeanMiePhase(ray.tile.y, ray.tile.x, ray.mu_s);
  if (ray.ground) {
    vec4 sun = GetSunOnGround(ray.h, ray.mu_s, ray.nu, ray.d);
    radiance += single.transmittance * ground_albedo / kPi * sun;
  }
  result = radiance / GetFading(ray.mu_s);
}
