// One more order of the precomputed sky, in each direction of the quadrature ("incident" in
// lib/bruneton_field.glsl): what the source of that order sends along the direction, and the
// ground under the light of the order before.

#include "lib/bruneton_field.glsl"

out vec4 result;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  ivec2 tile = texel / field_size.yx;
  ivec2 cell = texel - tile * field_size.yx;
  float mu_s = GetSunCosineOfSample(cell.x, field_size.y);
  float h = GetAltitudeOfCoordinate(float(cell.y) / float(field_size.x - 1));
  float mu = GetFieldZenithCosine(tile.y);
  float nu = GetScatteringCosine(mu, mu_s, cos(GetAzimuth(tile.x, FIELD_AZIMUTHS)));
  bool ground = RayIntersectsGround(h, mu);
  float d = ground ? GetDistanceToGround(h, mu) : GetDistanceToTop(h, mu);
  result = GatherSource(h, mu, mu_s, nu, d, ground, vec4(0.0)) / GetFading(mu_s);
}
