// Single scattering along a ray: sunlight scattered once by air or haze, without the phase function,
// which is constant along the ray and applied at the look-up (Bruneton & Neyret 2008, 4).

#include "bruneton/coordinates.glsl"

uniform sampler2D columns;

const int kSingleSteps = 48;

struct SingleScattering {
  vec4 air;
  vec4 haze;
  vec4 transmittance;  // to the end of the ray
};

SingleScattering ComputeSingleScattering(Length h, Number mu, Number mu_s, Number nu, Length d) {
  float r = kGroundRadius + h;
  mat3x4 coefficients = GetExtinctionCoefficients();
  SingleScattering single = SingleScattering(vec4(0.0), vec4(0.0), vec4(1.0));
  for (int i = 0; i < kSingleSteps; ++i) {
    float u = (float(i) + 0.5) / float(kSingleSteps);
    float t = d * u * u;
    float dt = 2.0 * d * u / float(kSingleSteps);
    float h_t = GetAltitudeAlongRay(h, mu, t);
    float mu_s_t = clamp((r * mu_s + t * nu) / (kGroundRadius + h_t), -1.0, 1.0);
    vec3 density = GetDensity(h_t);
    vec4 rayleigh = coefficients[0] * density.x;
    vec4 mie = coefficients[1] * density.y;
    vec4 extinction = coefficients * density;
    vec4 light = single.transmittance * GetTransmittanceToSun(columns, h_t, mu_s_t)
        * IntegrateTransmittance(extinction, dt);
    single.air += rayleigh * light;
    single.haze += mie * aerosol_albedo * light;
    single.transmittance *= exp(-extinction * dt);
  }
  return single;
}

// Sunlight on level ground where the ray from h meets it.
IrradianceSpectrum GetSunOnGround(Length h, Number mu_s, Number nu, Length d) {
  float cosine = clamp(((kGroundRadius + h) * mu_s + d * nu) / kGroundRadius, -1.0, 1.0);
  return max(cosine, 0.0) * GetTransmittanceToSun(columns, 0.0, cosine);
}
