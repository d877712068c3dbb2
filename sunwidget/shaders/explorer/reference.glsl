// The sky by path tracing: all orders of scattering with their true phase functions and no table except
// that of path lengths to the sun. One path per pixel and run; `history` holds the mean of the previous
// runs. Slow and noisy, but the reference for the other models.
//
// Single scattering is marched, in strata with one random place in each, so that noise affects only
// higher orders (as in validation/path_tracer.py). The path is traced for the second order and
// above: at every event the sun is sampled directly (next-event estimation), rays to space are
// forced to scatter, and paths end by Russian roulette. All orders means 24: the rest is
// 1e-6 of the light over grass or snow, and 0.4 % over white ground in thick white haze.

#include "explorer/path.glsl"
#include "explorer/projection.glsl"
#include "atmosphere/sky_description.glsl"

uniform float scattering_orders;  // 0 all, 1 single scattering, n the first n
uniform float sample_index;       // runs before this one
uniform vec2 tile_origin;
uniform sampler2D history;
out vec4 result;

const int kMostOrders = 24;
const int kStrata = 48;

RadianceSpectrum MarchFirstOrder(Path path, vec3 sun, mat3x4 coefficients) {
  float mu = clamp(path.direction.y, -1.0, 1.0);
  float mu_s = sun.y;
  float nu = clamp(dot(path.direction, sun), -1.0, 1.0);
  float h = path.h;
  float r = kGroundRadius + h;
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  float rayleigh_phase = RayleighPhase(nu);
  float mie_phase = MiePhase(aerosol_asymmetry, nu) * aerosol_albedo;
  float place = GetRandom();
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  float start = 0.0;
  for (int i = 0; i < kStrata; ++i) {
    float u = float(i + 1) / float(kStrata);
    float end = d * u * u;
    // Light is sampled at a random place in the stratum, extinction in its middle: the exponential of
    // a random depth would on average be brighter than that of its mean.
    vec4 extinction = coefficients * GetDensity(GetAltitudeAlongRay(h, mu, 0.5 * (start + end)));
    float t = mix(start, end, place);
    float h_t = GetAltitudeAlongRay(h, mu, t);
    float mu_s_t = clamp((r * mu_s + t * nu) / (kGroundRadius + h_t), -1.0, 1.0);
    vec3 density = GetDensity(h_t);
    vec4 scattered = coefficients[0] * density.x * rayleigh_phase
        + coefficients[1] * density.y * mie_phase;
    radiance += transmittance * scattered * GetTransmittanceToSun(columns, h_t, mu_s_t)
        * IntegrateTransmittance(extinction, end - start);
    transmittance *= exp(-extinction * (end - start));
    start = end;
  }
  if (ground) {
    float mu_s_ground = clamp((r * mu_s + d * nu) / kGroundRadius, -1.0, 1.0);
    radiance += transmittance * ground_albedo / kPi * max(mu_s_ground, 0.0)
        * GetTransmittanceToSun(columns, 0.0, mu_s_ground);
  }
  return radiance;
}

// Light of the second order and above along `path`.
RadianceSpectrum TraceHigherOrders(Path path, vec3 sun, int orders, mat3x4 coefficients) {
  int hero = int(4.0 * GetRandom());
  vec4 radiance = vec4(0.0);
  for (int order = 1; order <= kMostOrders; ++order) {
    bool on_ground = GoToNextEvent(path, hero, coefficients);
    NormalizePath(path, hero);
    float mu_s = clamp(dot(path.up, sun), -1.0, 1.0);
    float nu = clamp(dot(path.direction, sun), -1.0, 1.0);
    vec3 density = GetDensity(path.h);
    vec4 rayleigh = coefficients[0] * density.x;
    vec4 mie = coefficients[1] * density.y * aerosol_albedo;
    vec4 towards_sun = on_ground
        ? vec4(ground_albedo / kPi * max(mu_s, 0.0))
        : rayleigh * RayleighPhase(nu) + mie * MiePhase(aerosol_asymmetry, nu);
    if (order > 1) {
      radiance += GetPathWeight(path) * towards_sun * GetTransmittanceToSun(columns, path.h, mu_s);
    }
    if (order >= orders) break;
    if (on_ground) {
      path.transport *= ground_albedo;
      ReflectByGround(path);
    } else {
      Scatter(path, hero, rayleigh, mie);
    }
    NormalizePath(path, hero);
    vec4 weight = GetPathWeight(path);
    float survival = clamp(max(max(weight.r, weight.g), max(weight.b, weight.a)), 0.0, 1.0);
    if (GetRandom() >= survival) break;
    path.transport /= survival;
  }
  return radiance;
}

void main() {
  vec2 pixel = gl_FragCoord.xy + tile_origin;
  vec3 direction;
  if (!GetViewDirection(pixel, direction)) {
    result = vec4(0.0);
    return;
  }
  StartRandom(uvec2(pixel), uint(sample_index));
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  mat3x4 coefficients = GetExtinctionCoefficients();
  Path path = Path(GetCameraHeight(), vec3(0.0, 1.0, 0.0), direction, vec4(1.0), vec4(1.0));
  vec4 radiance = MarchFirstOrder(path, sun, coefficients);
  int orders = scattering_orders < 0.5 ? kMostOrders : int(scattering_orders + 0.5);
  if (orders > 1) radiance += TraceHigherOrders(path, sun, orders, coefficients);
  vec4 mean = sample_index > 0.5 ? texelFetch(history, ivec2(gl_FragCoord.xy), 0) : vec4(0.0);
  result = mix(mean, kSolarIrradiance * radiance, 1.0 / (sample_index + 1.0));
}
