// The field of previously scattered light around a point, stored as moments.
//
// Hillaire 2020 stores only the mean radiance and scatters it evenly. Here the field has its
// moments up to second order, in the frame x = horizontal towards the sun, z = zenith (y, across,
// follows by symmetry). They suffice for Rayleigh's phase function, and for most of the effect of
// haze: against path tracing the error falls from 6 to 2 % by day and from 15 to 4 % in the blue
// at sunset, and in haze from 33 to 7 %.
//
//   mean = <L>   x = <L w_x>   z = <L w_z>   xx = <L (w_x^2 - 1/3)>   zz, xz alike
//   lobe = <L P_3(nu)>
//
// with <> the mean over all directions w from which light comes, per unit of solar irradiance.
// The last one is the light that haze concentrates around the sun, beyond the other moments.
// Texture: seven tiles side by side in this order, divided by GetTwilight; within a tile mu_s along
// x, altitude along y.

#include "atmosphere/atmosphere.glsl"

const int kMoments = 7;
const int kAzimuths = 8;  // of the first order, over half a circle
const int kZeniths = 8;   // four-point Gauss-Legendre on each hemisphere
const int kSecondAzimuths = 4;
const float kNodes[4] = float[4](0.0694318442, 0.3300094782, 0.6699905218, 0.9305681558);
const float kWeights[4] = float[4](0.1739274226, 0.3260725774, 0.3260725774, 0.1739274226);
// Edges of the part of [0, 1] that each node represents.
const float kEdges[5] = float[5](0.0, 0.1739274226, 0.5, 0.8260725774, 1.0);

struct LightField {
  vec4 mean;
  vec4 x;
  vec4 z;
  vec4 xx;
  vec4 zz;
  vec4 xz;
  vec4 lobe;
};

// ---- Coordinates ----------------------------------------------------------------------------
// mu_s is dense around the terminator and below it, altitude on a cube-root scale (haze lies low).
// Once the sun is down the light falls by a factor of e every degree, far too fast to interpolate;
// so the table divides it by an approximation of that fall, the density at the height of the shadow.

const float kNightCosine = -0.35;
const float kNightShare = 0.65;  // of the table
const Length kTwilightScaleHeight = 24000.0;  // in standard air

vec2 GetFieldCoordinate(Length h, Number mu_s) {
  float night = kNightShare * (1.0 - pow(clamp(mu_s / kNightCosine, 0.0, 1.0), 2.0 / 3.0));
  float day = kNightShare + (1.0 - kNightShare) * sqrt(max(mu_s, 0.0));
  return vec2(mu_s < 0.0 ? night : day, pow(h / kAtmosphereHeight, 1.0 / 3.0));
}

Number GetSunCosineOfField(Number x) {
  float night = max(1.0 - x / kNightShare, 0.0);
  float day = max(x - kNightShare, 0.0) / (1.0 - kNightShare);
  return kNightCosine * night * sqrt(night) + day * day;
}

Number GetTwilight(Number mu_s) {
  float down = min(mu_s, 0.0);
  float scale = kTwilightScaleHeight * (rayleigh_scale_height / kRayleighScaleHeight);
  return exp(-0.5 * kGroundRadius / scale * down * down);
}

Length GetAltitudeOfField(Number y) {
  return max(y * y * y * kAtmosphereHeight, 1.0);
}

Number GetZenithCosine(int zenith) {
  return zenith < 4 ? kNodes[zenith] : -kNodes[zenith - 4];
}

Angle GetAzimuth(int azimuth, int azimuths) {
  return kPi * (float(azimuth) + 0.5) / float(azimuths);
}

// Components x and z of a direction in the frame of the sun.
vec2 GetFieldDirection(int zenith, int azimuth, int azimuths) {
  float mu = GetZenithCosine(zenith);
  return vec2(sqrt(1.0 - mu * mu) * cos(GetAzimuth(azimuth, azimuths)), mu);
}

// ---- Quadrature -----------------------------------------------------------------------------
// An order's radiance is drawn for each direction: tiles of azimuth along x and of zenith angle
// along y, each with mu_s along x and altitude along y.

struct FieldRay {
  ivec2 tile;  // azimuth, zenith angle
  Length h;
  Number mu;
  Number mu_s;
  Number nu;
  bool ground;
  Length d;  // to the ground or to the top
};

FieldRay GetFieldRay(ivec2 texel, ivec2 size, int azimuths) {
  size /= ivec2(azimuths, kZeniths);
  ivec2 tile = texel / size;
  vec2 place = vec2(texel - tile * size) / vec2(size - 1);
  float mu_s = GetSunCosineOfField(place.x);
  float h = GetAltitudeOfField(place.y);
  vec2 direction = GetFieldDirection(tile.y, tile.x, azimuths);
  float mu = direction.y;
  bool ground = RayIntersectsGround(h, mu);
  return FieldRay(tile, h, mu, mu_s, mu * mu_s + direction.x * sqrt(1.0 - mu_s * mu_s), ground,
                  ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu));
}

// ---- Look-up --------------------------------------------------------------------------------

vec4 FetchMoment(sampler2D field, ivec2 corner, vec2 part) {
  vec4 upper = mix(texelFetch(field, corner, 0), texelFetch(field, corner + ivec2(1, 0), 0), part.x);
  vec4 lower = mix(texelFetch(field, corner + ivec2(0, 1), 0),
                   texelFetch(field, corner + ivec2(1, 1), 0), part.x);
  return mix(upper, lower, part.y);
}

LightField GetLightField(sampler2D field, Length h, Number mu_s) {
  ivec2 last = textureSize(field, 0) / ivec2(kMoments, 1) - 1;
  ivec2 next = ivec2(last.x + 1, 0);
  vec2 place = clamp(GetFieldCoordinate(h, mu_s), 0.0, 1.0) * vec2(last);
  ivec2 corner = min(ivec2(place), last - 1);
  vec2 part = place - vec2(corner);
  float twilight = GetTwilight(mu_s);
  return LightField(twilight * FetchMoment(field, corner, part),
                    twilight * FetchMoment(field, corner + next, part),
                    twilight * FetchMoment(field, corner + 2 * next, part),
                    twilight * FetchMoment(field, corner + 3 * next, part),
                    twilight * FetchMoment(field, corner + 4 * next, part),
                    twilight * FetchMoment(field, corner + 5 * next, part),
                    twilight * FetchMoment(field, corner + 6 * next, part));
}

// First three Legendre moments of the Cornette-Shanks phase function (HG's are g, g^2, g^3).
vec3 GetMieMoments(Number g) {
  float g2 = g * g;
  float first = g + (2.0 * g * g2 + 3.0 * g) / 5.0;
  float second = g2 + 12.0 / 35.0 * g2 * g2 + 11.0 / 21.0 * g2 + 2.0 / 15.0;
  float third = g * g2 * (1.0 + 20.0 / 63.0 * g2 + 23.0 / 45.0) + 6.0 / 35.0 * g;
  return 1.5 / (2.0 + g2) * vec3(first, second, third);
}

// The part of the sun's lobe beyond its second moment that remains after a second scattering by haze,
// per unit of the field's third moment. A lobe of moments chi_l, scattered again, has chi_l^2; it is
// approximated by the Henyey-Greenstein function of the same third moment, less its first three terms.
Number GetLobe(vec3 mie_moments, Number nu) {
  float third = mie_moments.z;
  float g = pow(third * third, 1.0 / 3.0);
  float base = 1.0 + g * g - 2.0 * g * nu;
  float whole = (1.0 - g * g) / (base * sqrt(base));
  float kept = 1.0 + 3.0 * g * nu + 2.5 * g * g * (3.0 * nu * nu - 1.0);
  return (whole - kept) / max(third, 1e-3);
}

// Light of the field that air and haze scatter towards a viewer looking along `direction` (its x and z
// components), for a scattering coefficient of one.
vec4 GetQuadrupole(LightField field, vec2 direction) {
  float xx = direction.x * direction.x;
  float zz = direction.y * direction.y;
  float yy = max(1.0 - xx - zz, 0.0);
  return field.xx * (xx - yy) + field.zz * (zz - yy)
      + 2.0 * field.xz * (direction.x * direction.y);
}

// Rayleigh's phase function is 1 + P_2 / 2: its first moment is 0, its second 1/10.
vec4 GetFieldThroughAir(LightField field, vec2 direction) {
  return field.mean + 0.75 * GetQuadrupole(field, direction);
}

// `lobe` is GetLobe of the view. After sunset there is no lobe, and a negative moment does not mean a
// hole around the sun. A truncated series can dip below zero, so at least a tenth of the mean is kept.
vec4 GetFieldThroughHaze(LightField field, vec2 direction, vec3 moments, Number lobe) {
  vec4 dipole = field.x * direction.x + field.z * direction.y;
  vec4 sum = field.mean + 3.0 * moments.x * dipole
      + 7.5 * moments.y * GetQuadrupole(field, direction) + lobe * max(field.lobe, 0.0);
  return max(sum, 0.1 * field.mean);
}

// Irradiance of the field on level ground, by the same series.
vec4 GetFieldIrradiance(LightField field) {
  return kPi * max(field.mean + 2.0 * field.z + 1.875 * field.zz, 0.0);
}

// x and z components of a view direction in the frame at a point along it.
vec2 GetDirectionInField(Number mu, Number mu_s, Number nu) {
  float x = (nu - mu * mu_s) / sqrt(max(1.0 - mu_s * mu_s, 1e-8));
  return vec2(clamp(x, -1.0, 1.0), mu);
}
