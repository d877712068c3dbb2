// Scattered light by direction at every altitude and sun: the intermediate textures from which the
// precomputed sky's orders of scattering are computed.
//
// Two textures, both divided by GetFading and per unit of solar irradiance:
//   incident   radiance of one order in each direction of a quadrature (eight-point
//              Gauss-Legendre on each hemisphere times kFieldAzimuths over half a circle):
//              tiles of azimuth along x and zenith along y, each with mu_s along x, r along y
//   source     its light scattered by air (upper half) and haze (lower half) towards a viewer
//              looking along theta, phi, for a scattering coefficient of one: the mean of the
//              radiance over their phase functions. Tiles of phi along x and theta along y.
// Bruneton stores the density of scattered light itself; without the density of the air it varies
// slowly with altitude, so that a coarse r is enough.

#include "bruneton/coordinates.glsl"

uniform ivec4 field_size;  // samples of r, mu_s, theta, phi
uniform sampler2D source;
uniform sampler2D irradiance;  // scattered light on level ground, mu_s along x

const int kFieldZeniths = 16;
const int kFieldAzimuths = 16;
const float kFieldNodes[8] = float[8](0.0198550718, 0.1016667613, 0.2372337950, 0.4082826788,
    0.5917173212, 0.7627662050, 0.8983332387, 0.9801449282);
const float kFieldWeights[8] = float[8](0.0506142681, 0.1111905172, 0.1568533229, 0.1813418917,
    0.1813418917, 0.1568533229, 0.1111905172, 0.0506142681);
// Edges of the part of [0, 1] that each node represents.
const float kFieldEdges[9] = float[9](0.0000000000, 0.0506142681, 0.1618047854, 0.3186581083,
    0.5000000000, 0.6813418917, 0.8381952146, 0.9493857319, 1.0000000000);

// Upper hemisphere first; eight points each.
Number GetFieldZenithCosine(int zenith) {
  return zenith < 8 ? kFieldNodes[zenith] : -kFieldNodes[zenith - 8];
}

Number GetFieldWeight(int zenith) {
  return 0.5 * kFieldWeights[zenith % 8] / float(kFieldAzimuths);
}

// The ray that a texel of "incident" represents.
struct IncidentRay {
  ivec2 tile;  // azimuth, zenith
  Length h;
  Number mu;
  Number mu_s;
  Number nu;
  bool ground;
  Length d;  // to the ground or the top
};

IncidentRay GetIncidentRay(ivec2 texel) {
  ivec2 tile = texel / field_size.yx;
  ivec2 cell = texel - tile * field_size.yx;
  float mu_s = GetSunCosineOfSample(cell.x, field_size.y);
  float h = GetAltitudeOfCoordinate(float(cell.y) / float(field_size.x - 1));
  float mu = GetFieldZenithCosine(tile.y);
  float nu = GetScatteringCosine(mu, mu_s, cos(GetAzimuth(tile.x, kFieldAzimuths)));
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  return IncidentRay(tile, h, mu, mu_s, nu, ground, d);
}

// Means of the light around a point over the phase functions of air and haze.
struct Source {
  vec4 air;
  vec4 haze;
};

// Bilinear in azimuth and altitude, for one sun.
vec4 FetchTiles(ivec2 place, int next_tile, vec2 part) {
  vec4 upper = mix(texelFetch(source, place, 0),
                   texelFetch(source, place + ivec2(next_tile, 0), 0), part.x);
  vec4 lower = mix(texelFetch(source, place + ivec2(0, 1), 0),
                   texelFetch(source, place + ivec2(next_tile, 1), 0), part.x);
  return mix(upper, lower, part.y);
}

// The same, and linear in the zenith angle.
vec4 FetchDirections(ivec2 place, vec3 part) {
  return mix(FetchTiles(place, field_size.y, part.xy),
             FetchTiles(place + ivec2(0, field_size.x), field_size.y, part.xy), part.z);
}

vec4 FetchSource(ivec2 place, vec3 part, float sun_part) {
  return MixSuns(FetchDirections(place, part), FetchDirections(place + ivec2(1, 0), part), sun_part);
}

Source GetSource(Length h, Number mu, Number mu_s, Number nu) {
  vec2 place = vec2(GetSunCoordinate(mu_s, field_size.y),
                    GetAltitudeCoordinate(h) * float(field_size.x - 1));
  vec2 direction = vec2(
      GetAzimuthCoordinate(GetCosineOfAzimuth(mu, mu_s, nu), field_size.w),
      acos(clamp(mu, -1.0, 1.0)) / kPi * float(field_size.z - 1));
  ivec2 corner = clamp(ivec2(place), ivec2(0), field_size.yx - 2);
  ivec2 tile = clamp(ivec2(direction), ivec2(0), field_size.wz - 2);
  float sun_part = place.x - float(corner.x);
  vec3 part = vec3(direction.x - float(tile.x), place.y - float(corner.y),
                   direction.y - float(tile.y));
  float twilight = GetFading(mu_s);
  ivec2 air = tile * field_size.yx + corner;
  ivec2 haze = air + ivec2(0, field_size.z * field_size.x);
  return Source(twilight * FetchSource(air, part, sun_part),
                twilight * FetchSource(haze, part, sun_part));
}

IrradianceSpectrum GetScatteredIrradiance(Number mu_s) {
  float place = GetSunCoordinate(mu_s, field_size.y);
  int corner = clamp(int(place), 0, field_size.y - 2);
  return GetFading(mu_s) * MixSuns(texelFetch(irradiance, ivec2(corner, 0), 0),
      texelFetch(irradiance, ivec2(corner + 1, 0), 0), place - float(corner));
}

// The field is smooth: one look-up serves a group of steps.
const int kSourceGroups = 16;
const int kSourceGroupSteps = 2;

// Radiance of the source along mu as seen from h, plus that of the ground under the source's light and
// `sun_on_ground`, the sun's irradiance there.
RadianceSpectrum GatherSource(Length h, Number mu, Number mu_s, Number nu, Length d, bool ground,
                              IrradianceSpectrum sun_on_ground) {
  float r = kGroundRadius + h;
  mat3x4 coefficients = GetExtinctionCoefficients();
  vec4 transmittance = vec4(1.0);
  vec4 radiance = vec4(0.0);
  for (int group = 0; group < kSourceGroups; ++group) {
    float u_group = (float(group) + 0.5) / float(kSourceGroups);
    float t_group = d * u_group * u_group;
    float h_group = GetAltitudeAlongRay(h, mu, t_group);
    float r_group = kGroundRadius + h_group;
    Source light = GetSource(h_group, clamp((r * mu + t_group) / r_group, -1.0, 1.0),
                             clamp((r * mu_s + t_group * nu) / r_group, -1.0, 1.0), nu);
    for (int i = 0; i < kSourceGroupSteps; ++i) {
      float steps = float(kSourceGroups * kSourceGroupSteps);
      float u = (float(group * kSourceGroupSteps + i) + 0.5) / steps;
      float dt = 2.0 * d * u / steps;
      vec3 density = GetDensity(GetAltitudeAlongRay(h, mu, d * u * u));
      vec4 rayleigh = coefficients[0] * density.x;
      vec4 mie = coefficients[1] * density.y;
      vec4 extinction = coefficients * density;
      radiance += transmittance * (rayleigh * light.air + mie * aerosol_albedo * light.haze)
          * IntegrateTransmittance(extinction, dt);
      transmittance *= exp(-extinction * dt);
    }
  }
  if (ground) {
    float mu_s_ground = clamp((r * mu_s + d * nu) / kGroundRadius, -1.0, 1.0);
    radiance += transmittance * ground_albedo / kPi
        * (sun_on_ground + GetScatteredIrradiance(mu_s_ground));
  }
  return radiance;
}
