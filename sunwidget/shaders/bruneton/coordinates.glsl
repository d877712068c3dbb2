// Coordinates of the precomputed sky, after Bruneton & Neyret, "Precomputed Atmospheric
// Scattering" (2008) and Bruneton's second implementation (2017): radiance over
//   r     altitude h, evenly in the fourth root of h, because haze lies low (Bruneton: square root)
//   mu    view zenith angle, by the distance to the end of the ray: the ground in the first
//         half of the samples, the top of the atmosphere in the second, so that no look-up
//         interpolates across the horizon (Bruneton 2017, "Scattering texture"). Towards the top
//         evenly in its square root, or the highest 40 degrees would lie between two samples
//   mu_s  sun zenith angle, dense around the terminator
//   nu    angle between view and sun, as their difference in azimuth. Bruneton spaces nu itself
//         evenly over [-1, 1], half of which cannot occur; here every sample is used.
// The table is divided by GetFading, an approximation of how light falls once the sun is down; unlike
// GetTwilight of atmosphere/multiple.glsl it has no parameter, so it does not depend on the sliders.

#include "atmosphere/multiple.glsl"

// ---- Altitude -------------------------------------------------------------------------------

float GetAltitudeCoordinate(Length h) {
  return sqrt(sqrt(GetSquaredHorizonDistance(h)) / kLongestHorizon);
}

Length GetAltitudeOfCoordinate(float y) {
  float rho = y * y * kLongestHorizon;
  return rho * rho / (sqrt(kGroundRadius * kGroundRadius + rho * rho) + kGroundRadius);
}

// ---- View -----------------------------------------------------------------------------------

// Position of a view among `count` samples: 0 is straight down, count / 2 - 1 the ground at the
// horizon, count / 2 the zenith, count - 1 the sky at the horizon.
float GetViewCoordinate(Length h, Number mu, bool ground, int count) {
  float rho = sqrt(GetSquaredHorizonDistance(h));
  float last = float(count / 2 - 1);
  if (ground) {
    float x = rho > h ? (GetDistanceToGround(h, mu) - h) / (rho - h) : 0.0;
    return last * clamp(x, 0.0, 1.0);
  }
  float d_min = kAtmosphereHeight - h;
  float x = (GetDistanceToTop(h, mu) - d_min) / (rho + kLongestHorizon - d_min);
  return last + 1.0 + last * sqrt(clamp(x, 0.0, 1.0));
}

// Zenith cosine (x) of sample `index`, and its distance to the ground or the top (y).
vec2 GetViewOfSample(Length h, int index, int count) {
  float rho2 = GetSquaredHorizonDistance(h);
  float rho = sqrt(rho2);
  float last = float(count / 2 - 1);
  float r = kGroundRadius + h;
  if (index < count / 2) {
    float d = h + float(index) / last * (rho - h);
    // From |ground|^2 = r^2 + d^2 + 2 r d mu.
    return vec2(d > 0.0 ? clamp(-(rho2 + d * d) / (2.0 * r * d), -1.0, 1.0) : -1.0, d);
  }
  float d_min = kAtmosphereHeight - h;
  float x = float(index - count / 2) / last;
  float d = d_min + x * x * (rho + kLongestHorizon - d_min);
  float shell = (kAtmosphereHeight - h) * (kTopRadius + kGroundRadius + h);
  return vec2(d > 0.0 ? clamp((shell - d * d) / (2.0 * r * d), -1.0, 1.0) : 1.0, d);
}

// ---- Sun and azimuth ------------------------------------------------------------------------

// Even in the inverse hyperbolic sine of the elevation: dense around the terminator, where the path
// through the air to the sun changes fastest, and down to -18 degrees; by day close enough that
// the aureole moves little from sample to sample.
const Angle kLowestSun = -0.314;
const float kTerminator = 0.36;  // position of mu_s = 0 in [0, 1]
const Angle kDayScale = 0.1;
const Angle kNightScale = 0.08;

float GetSunCoordinate(Number mu_s, int count) {
  float elevation = asin(clamp(mu_s, -1.0, 1.0));
  float x = elevation < 0.0
      ? kTerminator * (1.0 - asinh(-elevation / kNightScale) / asinh(-kLowestSun / kNightScale))
      : kTerminator + (1.0 - kTerminator) * asinh(elevation / kDayScale) / asinh(0.5 * kPi / kDayScale);
  return clamp(x, 0.0, 1.0) * float(count - 1);
}

Number GetSunCosineOfSample(int index, int count) {
  float x = float(index) / float(count - 1);
  float night = max(1.0 - x / kTerminator, 0.0);
  float day = max(x - kTerminator, 0.0) / (1.0 - kTerminator);
  return sin(kDayScale * sinh(day * asinh(0.5 * kPi / kDayScale))
      - kNightScale * sinh(night * asinh(-kLowestSun / kNightScale)));
}

Number GetFading(Number mu_s) {
  float down = min(mu_s, 0.0);
  return exp(-0.5 * kGroundRadius / kTwilightScaleHeight * down * down);
}

// Interpolates the logarithm of light between two suns, because light fades as the exponential of a path.
vec4 MixSuns(vec4 low, vec4 high, float part) {
  return exp(mix(log(max(low, vec4(1e-12))), log(max(high, vec4(1e-12))), part));
}

// Cosine of the azimuth between view and sun. Undefined at the zenith, where it has no effect.
Number GetCosineOfAzimuth(Number mu, Number mu_s, Number nu) {
  float across = sqrt(max((1.0 - mu * mu) * (1.0 - mu_s * mu_s), 1e-12));
  return clamp((nu - mu * mu_s) / across, -1.0, 1.0);
}

Number GetScatteringCosine(Number mu, Number mu_s, Number cosine_of_azimuth) {
  float across = sqrt(max((1.0 - mu * mu) * (1.0 - mu_s * mu_s), 0.0));
  return clamp(mu * mu_s + across * cosine_of_azimuth, -1.0, 1.0);
}

Number GetCosineOfAzimuthSample(float index, int count) {
  return cos(kPi * index / float(count - 1));
}

// Position among `count` samples from azimuth 0 to pi. They are even in the angle, but light varies with
// its cosine: interpolation linear in the cosine gives the correct flat slope at both ends.
float GetAzimuthCoordinate(Number cosine_of_azimuth, int count) {
  float index = floor(acos(cosine_of_azimuth) / kPi * float(count - 1));
  index = min(index, float(count - 2));
  float near = GetCosineOfAzimuthSample(index, count);
  float far = GetCosineOfAzimuthSample(index + 1.0, count);
  return index + clamp((near - cosine_of_azimuth) / (near - far), 0.0, 1.0);
}
