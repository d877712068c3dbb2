// The sky view of sky_view.glsl from the precomputed sky instead of a march: same layout, same
// guess, same description, so that later passes read both alike. `bruneton` is the slice of the
// table for one altitude: single scattering by air, by haze, and all other light, one above the
// other, mu_s along y, mu and nu along x (bruneton/coordinates.glsl). Its last row describes it:
// altitude, asymmetry, and the numbers of samples of nu and mu_s. Moving the sun needs no new slice;
// for other air or another altitude the kernel makes one.

#include "bruneton/coordinates.glsl"
#include "atmosphere/sky_description.glsl"

uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D bruneton;
out vec4 result;

// Linear in azimuth and view, for one sun.
vec4 FetchView(ivec2 corner, int azimuths, vec2 part) {
  vec4 upper = mix(texelFetch(bruneton, corner, 0),
                   texelFetch(bruneton, corner + ivec2(1, 0), 0), part.x);
  vec4 lower = mix(texelFetch(bruneton, corner + ivec2(azimuths, 0), 0),
                   texelFetch(bruneton, corner + ivec2(azimuths + 1, 0), 0), part.x);
  return mix(upper, lower, part.y);
}

vec4 FetchTable(ivec2 corner, int azimuths, vec3 part) {
  return MixSuns(FetchView(corner, azimuths, part.xy),
                 FetchView(corner + ivec2(0, 1), azimuths, part.xy), part.z);
}

RadianceSpectrum LookUpSkyRadiance(Number mu, bool ground, Number mu_s, Number cosine_of_azimuth,
                                   Number nu) {
  ivec2 size = textureSize(bruneton, 0);
  vec4 description = texelFetch(bruneton, ivec2(0, size.y - 1), 0);
  float h = description.x;
  int azimuths = int(description.z);
  int suns = int(description.w);
  int views = size.x / azimuths;
  float azimuth = GetAzimuthCoordinate(cosine_of_azimuth, azimuths);
  float view = GetViewCoordinate(h, mu, ground, views);
  float sun = GetSunCoordinate(mu_s, suns);
  // Interpolation stays within its half of the views.
  int first = ground ? 0 : views / 2;
  ivec3 corner = ivec3(clamp(int(azimuth), 0, azimuths - 2),
                       clamp(int(view), first, first + views / 2 - 2),
                       clamp(int(sun), 0, suns - 2));
  vec3 part = vec3(azimuth, view, sun) - vec3(corner);
  ivec2 place = ivec2(corner.y * azimuths + corner.x, corner.z);
  vec4 air = FetchTable(place, azimuths, part);
  vec4 haze = FetchTable(place + ivec2(0, suns), azimuths, part);
  vec4 rest = FetchTable(place + ivec2(0, 2 * suns), azimuths, part);
  return kSolarIrradiance * GetFading(mu_s)
      * (air * RayleighPhase(nu) + haze * MiePhase(description.y, nu) + rest);
}

void main() {
  vec2 texel = gl_FragCoord.xy + tile_origin - 0.5;
  SkyView view = DescribeSky();
  ivec2 rows = GetSkyViewRows(int(pass_size.y));
  int row = int(texel.y + 0.5);
  int column = int(texel.x + 0.5);
  if (row == rows.y) {
    result = GetDescriptionTexel(view, column);
    return;
  }
  float elevation = GetElevationOfRow(float(row), rows, view.horizon);
  float azimuth = GetAzimuthOfColumn(float(column) / (pass_size.x - 1.0));
  float mu = sin(elevation);
  float mu_s = view.sun.y;
  float nu = mu * mu_s + cos(elevation) * sqrt(max(1.0 - mu_s * mu_s, 0.0)) * cos(azimuth);
  float h = texelFetch(bruneton, ivec2(0, textureSize(bruneton, 0).y - 1), 0).x;
  bool ground = row >= rows.x;
  float horizon = GetCosineOfHorizon(h);
  mu = ground ? min(mu, horizon) : max(mu, horizon);
  result = LookUpSkyRadiance(mu, ground, mu_s, cos(azimuth), nu) / GuessRadiance(view, nu);
}
