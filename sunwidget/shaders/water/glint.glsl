// The sun's glints on level water roughened by wind, after Cox & Munk 1954 ("Measurement of the
// roughness of the sea surface from photographs of the sun's glitter", JOSA 44, p. 838): normally
// distributed slopes (a share kSteepShare steeper), a little wider along the wind than across.

// Mean square slopes along and across the wind (their equations for a clean surface). The first has
// a minimum for swell and for the sun's own size, so that calm water is no mirror. Both are scaled by the
// roughness that the photo's own glints show relative to these (analysis/water/glitter.py).
uniform float water_roughness;

vec2 GetSlopeVariance(float wind) {
  return water_roughness * vec2(1e-3 + 3.16e-3 * wind, 3e-3 + 1.92e-3 * wind);
}

// Cosine between the line of sight and the visible facets: at grazing angles waves hide all facets
// but those that lean towards the viewer.
float GetFacing(vec3 view, float wind) {
  vec2 variance = GetSlopeVariance(wind);
  return sqrt(view.y * view.y + 0.5 * (variance.x + variance.y));
}

// Share of light reflected by water (Schlick 1994, F0 = 0.02).
float GetFresnel(float cosine) {
  float x = 1.0 - clamp(cosine, 0.0, 1.0);
  float square = x * x;
  return 0.02 + 0.98 * square * square * x;
}

// Steep slopes are more common than in a normal distribution (peakedness): kSteepShare of the waves have
// kSteepVariance times the variance of the rest. Otherwise the column of glints would have sharp sides.
const float kSteepShare = 0.1;
const float kSteepVariance = 6.0;

// Radiance of the glints towards the viewer per unit of the sun's irradiance, 1/sr. `wind` in m/s,
// `towards` its direction in degrees from the heading; `view` goes from the viewer to the water.
float GetGlint(vec3 sun, vec3 view, float wind, float towards) {
  vec3 facet = normalize(sun - view);
  float rise = max(facet.y, 1e-3);
  vec2 slope = facet.xz / rise;
  vec2 along = vec2(sin(radians(towards)), cos(radians(towards)));
  vec2 turned = vec2(dot(slope, along), dot(slope, vec2(along.y, -along.x)));
  vec2 variance = GetSlopeVariance(wind) / mix(1.0, kSteepVariance, kSteepShare);  // in total Cox and Munk's
  vec2 square = turned * turned / variance;
  float exponent = -0.5 * (square.x + square.y);
  float density = mix(exp(exponent), exp(exponent / kSteepVariance) / kSteepVariance, kSteepShare)
      / (6.2831853 * sqrt(variance.x * variance.y));
  float steepness = rise * rise;
  return GetFresnel(dot(facet, sun)) * density / (4.0 * GetFacing(view, wind) * steepness * steepness);
}
