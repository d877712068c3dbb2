// The precomputed sky itself, four-dimensional: nu and mu along x (nu fastest), mu_s and r along y
// (mu_s fastest), see bruneton/coordinates.glsl. Three tables, drawn one by one:
//   0  single scattering by air, without phase function
//   1  single scattering by haze, likewise (Bruneton packs one component and estimates the rest)
//   2  all other light: higher orders and the ground
// Per unit of solar irradiance, divided by GetFading.

#include "bruneton/field.glsl"
#include "bruneton/single.glsl"

uniform ivec4 table_size;  // samples of r, mu, mu_s, nu
uniform int part;
out vec4 result;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  int nu_index = texel.x % table_size.w;
  int sun = texel.y % table_size.z;
  float h = GetAltitudeOfCoordinate(float(texel.y / table_size.z) / float(table_size.x - 1));
  vec2 view = GetViewOfSample(h, texel.x / table_size.w, table_size.y);
  bool ground = texel.x / table_size.w < table_size.y / 2;
  float mu = view.x;
  float d = view.y;
  float mu_s = GetSunCosineOfSample(sun, table_size.z);
  float azimuth = GetCosineOfAzimuthSample(float(nu_index), table_size.w);
  float nu = GetScatteringCosine(mu, mu_s, azimuth);
  vec4 radiance;
  if (part == 2) {
    vec4 sun_on_ground = ground ? GetSunOnGround(h, mu_s, nu, d) : vec4(0.0);
    radiance = GatherSource(h, mu, mu_s, nu, d, ground, sun_on_ground);
  } else {
    SingleScattering single = ComputeSingleScattering(h, mu, mu_s, nu, d);
    radiance = part == 0 ? single.air : single.haze;
  }
  result = radiance / GetFading(mu_s);
}
