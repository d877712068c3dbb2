// The water without the old sun's glints: its light (water_level.glsl) with the waves of the water
// beside it at the same distance. Alpha: the effect of the photo's waves on new glints here
// (water/waves.glsl). Drawn once per photo. NO_GLINTS omits what only
// the zone of the old glints needs (water_parts.glsl).

#include "frame/picture.glsl"
#include "frame/strip.glsl"
#include "camera/response.glsl"
#include "water/waves.glsl"

uniform sampler2D photo;
uniform sampler2D surface;
uniform sampler2D water_level;
uniform vec2 tile_origin;

out vec4 result;

const int kPlaces = 6;
const float kHighestWave = 0.35;  // natural logarithm of brightness, in new glints
const float kRock = 2.0;  // in heights of the waves: a deviation from the water's light that gets half the weight
const float kBeside = 0.006;  // longer sides; in the same row, since a strip of a large picture has no other

// Inside the picture, mirrored at its sides.
float Reflect(float x) {
  return 1.0 - abs(1.0 - abs(x));
}

float GetBrightness(vec3 light, vec3 level) {
  return log(max(GetLuminance(light), 1e-5) / max(GetLuminance(level), 1e-5));
}

float GetSparkle(vec2 place, float wave) {
  wave *= inversesqrt(1.0 + wave * wave / (kHighestWave * kHighestWave));
  return EncodeSparkle(GetLogSparkle(GetViewDirection(place), 0.5 + 0.5 * wave / kHighestWave));
}

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  vec4 level = ReadBilinear(water_level, place);
  vec3 own = GetSceneLight(ReadPixel(photo, place).rgb);
  float seen = GetBrightness(own, level.rgb);
#ifdef NO_GLINTS
  result = vec4(own, GetSparkle(place, seen));
#else
  float sum = 0.0;
  float squares = 1e-4;
  for (int i = 0; i < kPlaces; ++i) {
    // No water at a similar distance. Leaving a loop saves time on software rendering, unlike a branch.
    if (level.a <= 0.0) break;
    float shift = (i % 2 == 0 ? -0.13 : 0.17) + 0.19 * float(i / 2) * (i % 2 == 0 ? -1.0 : 1.0);
    vec2 at = vec2(Reflect(place.x + shift), place.y);
    vec2 marks = ReadPixel(surface, at).gb;
    float weight = smoothstep(0.5, 1.0, marks.x) * (1.0 - marks.y) * (1.0 - marks.y);
    // The level is smooth: one look-up serves the pixels beside, too.
    vec3 level_there = ReadBilinear(water_level, at).rgb;
    float wave = GetBrightness(GetSceneLight(ReadPixel(photo, at).rgb), level_there);
    // Rocks that the mask includes as water stand out more than waves. Pixels near them count as little, or their
    // outlines would be waves.
    float most = abs(wave);
    for (int side = -1; side <= 1; side += 2) {
      vec2 beside = at + vec2(float(side) * kBeside * max(1.0, frame_size.y / frame_size.x), 0.0);
      // Its gray is precise enough to find a rock, and costs a third of its color.
      vec3 gray = vec3(GetLuminance(ReadPixel(photo, beside).rgb));
      most = max(most, abs(GetBrightness(GetSceneLight(gray), level_there)));
    }
    float rock = most / (kRock * max(level.a, kLowestWave));
    weight /= 1.0 + rock * rock * rock * rock;
    sum += weight * wave;
    squares += weight * weight;
  }
  // Waves summed over several places, scaled to the height of one place's.
  float wave = sum * inversesqrt(squares);
  // Without water free of glints, the pixel's own light is the best estimate.
  vec3 water = mix(own, level.rgb * exp(wave), smoothstep(0.0, kLowestWave, level.a));
  wave = mix(seen, wave, ReadPixel(surface, place).b);
  result = vec4(water, GetSparkle(place, wave));
#endif
}
