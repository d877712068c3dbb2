// Paths of light through the air, traced backwards from the camera, for four wavelengths at once
// (Wilkie et al., "Hero Wavelength Spectral Sampling", 2014): every choice follows the probabilities
// of one randomly drawn wavelength, the hero. A path carries its transport at each wavelength and the
// likelihood with which each of the four would have produced it as the hero; transport over the mean
// of the likelihoods (the balance heuristic) is an unbiased estimate at all four, with little
// noise in color.

#include "atmosphere/atmosphere.glsl"
#include "explorer/random.glsl"

uniform sampler2D columns;

struct Path {
  Length h;
  vec3 up;           // from the center of the earth
  vec3 direction;    // in which the path is traced
  vec4 transport;
  vec4 likelihood;   // with each wavelength as hero; 1 for the hero itself
};

const int kEventSteps = 40;

// 1 - exp(-x) without cancellation.
vec4 GetOpacity(vec4 x) {
  return mix(1.0 - exp(-x), x * (1.0 - 0.5 * x), lessThan(x, vec4(1e-3)));
}

float PickHero(vec4 spectrum, int hero) {
  return hero == 0 ? spectrum.r : hero == 1 ? spectrum.g : hero == 2 ? spectrum.b : spectrum.a;
}

// Distance along the ray at u in [0, 1]: dense at the start, and at the ground, where the air is dense.
Length GetEventDistance(float u, Length d, bool ground) {
  return d * u * u * (ground ? 3.0 - 2.0 * u : 1.0);
}

// Moves `path` to its next event in air, haze, ozone or on the ground, and returns whether it is on
// the ground; the caller applies scattering or albedo. Rays to space are forced to meet the air, with
// the corresponding weight; rays to the ground reach it as often as light does.
// A ray through a vacuum ends with a transport of zero.
bool GoToNextEvent(inout Path path, int hero, mat3x4 coefficients) {
  float mu = clamp(dot(path.up, path.direction), -1.0, 1.0);
  bool ground = RayIntersectsGround(path.h, mu);
  float d = ground ? GetDistanceToGround(path.h, mu) : GetDistanceToTop(path.h, mu);
  vec3 extinction = vec3(PickHero(coefficients[0], hero), PickHero(coefficients[1], hero),
                         PickHero(coefficients[2], hero));
  vec3 whole = vec3(0.0);
  float start = 0.0;
  for (int i = 0; i < kEventSteps; ++i) {
    float end = GetEventDistance(float(i + 1) / float(kEventSteps), d, ground);
    whole += GetDensity(GetAltitudeAlongRay(path.h, mu, 0.5 * (start + end))) * (end - start);
    start = end;
  }
  vec4 opacity = GetOpacity(coefficients * whole);
  float hero_opacity = PickHero(opacity, hero);
  float random = GetRandom();
  bool on_ground = ground && random >= hero_opacity;
  float t = d;
  vec3 column = whole;
  vec3 density = vec3(0.0);
  if (!on_ground) {
    if (hero_opacity <= 0.0) {
      path.transport = vec4(0.0);
      return false;
    }
    float target = -log(max(1.0 - (ground ? random : random * hero_opacity), 1e-30));
    float depth = 0.0;
    column = vec3(0.0);
    start = 0.0;
    for (int i = 0; i < kEventSteps; ++i) {
      float end = GetEventDistance(float(i + 1) / float(kEventSteps), d, ground);
      density = GetDensity(GetAltitudeAlongRay(path.h, mu, 0.5 * (start + end)));
      float step_depth = dot(extinction, density) * (end - start);
      if (depth + step_depth >= target || i == kEventSteps - 1) {
        float part = clamp((target - depth) / max(step_depth, 1e-30), 0.0, 1.0);
        column += density * (part * (end - start));
        t = mix(start, end, part);
        break;
      }
      column += density * (end - start);
      depth += step_depth;
      start = end;
    }
  }
  vec4 transmittance = exp(-(coefficients * column));
  path.transport *= transmittance;
  path.likelihood *= transmittance;
  if (!on_ground) {
    path.likelihood *= coefficients * density;
    path.likelihood /= ground ? vec4(1.0) : max(opacity, vec4(1e-30));
  }
  path.up = normalize((kGroundRadius + path.h) * path.up + t * path.direction);
  // A centimeter keeps the next ray out of the ground.
  path.h = on_ground ? 0.01 : max(GetAltitudeAlongRay(path.h, mu, t), 0.01);
  return on_ground;
}

// Divides by the hero's likelihood, so that no product overflows or underflows.
void NormalizePath(inout Path path, int hero) {
  float scale = 1.0 / max(PickHero(path.likelihood, hero), 1e-37);
  path.transport *= scale;
  path.likelihood *= scale;
}

vec4 GetPathWeight(Path path) {
  return path.transport / max(dot(path.likelihood, vec4(0.25)), 1e-37);
}

// ---- New directions -------------------------------------------------------------------------

vec3 GetDirectionAround(vec3 axis, Number cosine, Angle turn) {
  // Duff et al., "Building an Orthonormal Basis, Revisited" (2017).
  float side = axis.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (side + axis.z);
  float b = axis.x * axis.y * a;
  vec3 first = vec3(1.0 + side * axis.x * axis.x * a, side * b, -side * axis.x);
  vec3 second = vec3(b, side + axis.y * axis.y * a, -axis.y);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  return normalize(cosine * axis + sine * (cos(turn) * first + sin(turn) * second));
}

// Inverse of the integral of Rayleigh's phase function (Frisvad 2011).
Number SampleRayleigh(float random) {
  float x = 4.0 * random - 2.0;
  float u = pow(x + sqrt(x * x + 1.0), 1.0 / 3.0);
  return clamp(u - 1.0 / u, -1.0, 1.0);
}

// Henyey & Greenstein's function has an inverse and is within a factor of 1.5 of Cornette & Shanks'.
Number HenyeyGreenstein(Number g, Number nu) {
  float base = max(1.0 + g * g - 2.0 * g * nu, 1e-6);
  return (1.0 - g * g) / (4.0 * kPi * base * sqrt(base));
}

Number SampleHenyeyGreenstein(Number g, float random) {
  if (abs(g) < 1e-3) return 2.0 * random - 1.0;
  float x = (1.0 - g * g) / (1.0 - g + 2.0 * g * random);
  return clamp((1.0 + g * g - x * x) / (2.0 * g), -1.0, 1.0);
}

void ReflectByGround(inout Path path) {
  // Sampled by the cosine, which cancels: of Lambert's law only the albedo remains.
  path.direction = GetDirectionAround(path.up, sqrt(GetRandom()), 2.0 * kPi * GetRandom());
}

// Draws a new direction at an event in air and haze with these scattering coefficients.
void Scatter(inout Path path, int hero, vec4 rayleigh, vec4 mie) {
  vec4 by_air = rayleigh / max(rayleigh + mie, vec4(1e-37));
  bool air = GetRandom() < PickHero(by_air, hero);
  float random = GetRandom();
  float nu = air ? SampleRayleigh(random) : SampleHenyeyGreenstein(aerosol_asymmetry, random);
  path.direction = GetDirectionAround(path.direction, nu, 2.0 * kPi * GetRandom());
  // Count both phase functions, because either could have drawn this direction.
  float air_phase = RayleighPhase(nu);
  path.transport *= rayleigh * air_phase + mie * MiePhase(aerosol_asymmetry, nu);
  path.likelihood *= mix(vec4(HenyeyGreenstein(aerosol_asymmetry, nu)), vec4(air_phase), by_air);
}
