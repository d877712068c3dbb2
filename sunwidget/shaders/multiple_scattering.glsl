// Radiance that reaches a point after one scattering or more, averaged over all directions and
// summed over all orders, per unit of solar irradiance (1/sr). Texture: mu_s along x, altitude
// along y. Hillaire 2020, section 5.5: second order L_2 by quadrature, then the geometric series
// 1 / (1 - f). Unlike there, the first scattering keeps its true phase function (the paper's
// isotropic one loses a tenth of the blue at low sun), and f sees the ground's reflection too.

#include "lib/atmosphere.glsl"

uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D columns;
out vec4 result;

const int STEPS = 20;
const int AZIMUTHS = 8;
const int ZENITHS = 8;
// Four-point Gauss-Legendre on each hemisphere: radiance breaks at the horizon.
const float NODES[4] = float[4](0.0694318442, 0.3300094782, 0.6699905218, 0.9305681558);
const float WEIGHTS[4] = float[4](0.1739274226, 0.3260725774, 0.3260725774, 0.1739274226);

Number GetZenithCosine(int zenith) {
  return zenith < 4 ? NODES[zenith] : -NODES[zenith - 4];
}

// Half circle only: the other half mirrors it about the sun's vertical plane.
Number GetAzimuthCosine(int azimuth) {
  return cos(PI * (float(azimuth) + 0.5) / float(AZIMUTHS));
}

Number GetSunAngleCosine(Number mu, Number mu_s, int azimuth) {
  return mu * mu_s + sqrt((1.0 - mu * mu) * (1.0 - mu_s * mu_s)) * GetAzimuthCosine(azimuth);
}

// Quadrature of a narrow lobe depends on where its peak falls between the nodes; dividing by
// the quadrature of the lobe alone keeps its energy.
Number GetMieNormalisation(Number mu_s) {
  float sum = 0.0;
  for (int j = 0; j < ZENITHS; ++j) {
    float mu = GetZenithCosine(j);
    for (int k = 0; k < AZIMUTHS; ++k) {
      sum += WEIGHTS[j % 4] * MiePhase(aerosol_asymmetry, GetSunAngleCosine(mu, mu_s, k));
    }
  }
  return 2.0 * float(AZIMUTHS) / (4.0 * PI * sum);
}

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin - 0.5) / (pass_size - 1.0);
  float mu_s = GetSunCosineOfMultipleScattering(place.x);
  float h = max(place.y * place.y * ATMOSPHERE_HEIGHT, 1.0);
  float r = GROUND_RADIUS + h;
  vec4 mie_extinction = GetMieExtinction();
  vec4 ozone_absorption = GetOzoneAbsorption();
  float mie_normalisation = GetMieNormalisation(mu_s);

  vec4 second_order = vec4(0.0);
  vec4 transfer = vec4(0.0);
  for (int j = 0; j < ZENITHS; ++j) {
    float mu = GetZenithCosine(j);
    float weight = 0.5 * WEIGHTS[j % 4];
    bool ground = RayIntersectsGround(h, mu);
    float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
    vec4 transmittance = vec4(1.0);
    for (int i = 0; i < STEPS; ++i) {
      float u = (float(i) + 0.5) / float(STEPS);
      float t = d * u * u;
      float dt = 2.0 * d * u / float(STEPS);
      float h_t = GetAltitudeAlongRay(h, mu, t);
      vec3 density = GetDensity(h_t);
      vec4 rayleigh = RAYLEIGH_SCATTERING * density.x;
      vec4 mie = mie_extinction * density.y;
      vec4 extinction = rayleigh + mie + ozone_absorption * density.z;
      vec4 seen = transmittance * IntegrateTransmittance(extinction, dt);
      mie *= aerosol_albedo;
      vec4 first_order = vec4(0.0);
      for (int k = 0; k < AZIMUTHS; ++k) {
        float nu = GetSunAngleCosine(mu, mu_s, k);
        float mu_s_t = clamp((r * mu_s + t * nu) / (GROUND_RADIUS + h_t), -1.0, 1.0);
        vec4 phase = rayleigh * RayleighPhase(nu)
            + mie * (mie_normalisation * MiePhase(aerosol_asymmetry, nu));
        first_order += phase * GetTransmittanceToSun(columns, h_t, mu_s_t);
      }
      second_order += weight / float(AZIMUTHS) * seen * first_order;
      transfer += weight * seen * (rayleigh + mie);
      transmittance *= exp(-extinction * dt);
    }
    if (ground) {
      for (int k = 0; k < AZIMUTHS; ++k) {
        float nu = GetSunAngleCosine(mu, mu_s, k);
        float mu_s_t = clamp((r * mu_s + d * nu) / GROUND_RADIUS, -1.0, 1.0);
        second_order += weight / float(AZIMUTHS) * transmittance * ground_albedo / PI
            * max(mu_s_t, 0.0) * GetTransmittanceToSun(columns, 0.0, mu_s_t);
      }
      transfer += weight * transmittance * ground_albedo;
    }
  }
  result = second_order / (1.0 - min(transfer, vec4(0.999)));
}
