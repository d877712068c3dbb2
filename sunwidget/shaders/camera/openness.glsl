// How freely the sun shines through each part of the picture, for the light shafts: r is 1 in clear
// sky and 0 on land or thick cloud, times g, which is 1 above the horizon: parts below it never stand
// before the sun and carry no information. b, for the clouds' shadows on the land, is the share of
// sunlight that the clouds around this place block, averaged over the width of their penumbra. Both are
// soft, so an eighth of the size is enough; drawn when the clouds change, not when the sun moves.

#include "frame/picture.glsl"
#include "clouds/cloud_cover.glsl"

uniform sampler2D layers;
uniform sampler2D surface;
uniform vec2 pass_size;

out vec4 result;

const int kSide = 3;  // samples per side of each texel

const int kShadeTaps = 4;           // per side
const float kShadePace = 0.022;     // between taps, in heights of the picture

// White where the sun's glare clipped the photo is not cloud; land in front of the sky carries no information.
float GetShade(vec2 place) {
  vec2 layer = ReadPicture(layers, place).rg;
  float own = EditOpacity(layer.g, layer.r, ReadBilinear(clear_sky, place).a);
  float opacity = min(own / max(layer.r, 0.05), 1.0);
  opacity += (1.0 - opacity) * GetAddedCover(GetViewDirection(place));
  return opacity * smoothstep(0.0, 0.5, layer.r) * (1.0 - 0.8 * ReadPicture(surface, place).r);
}

float GetMeanShade(vec2 middle) {
  float sum = 0.0;
  for (int i = 0; i < kShadeTaps * kShadeTaps; ++i) {
    vec2 aside = (vec2(i % kShadeTaps, i / kShadeTaps) - 0.5 * float(kShadeTaps - 1)) * kShadePace;
    sum += GetShade(middle + aside * vec2(frame_size.y / frame_size.x, 1.0));
  }
  return sum / float(kShadeTaps * kShadeTaps);
}

void main() {
  vec2 corner = gl_FragCoord.xy - 0.5;
  vec2 middle = gl_FragCoord.xy / pass_size;
  // The old sun's glare whitens the sky even without a cloud.
  float trust = 1.0 - 0.8 * ReadBilinear(surface, middle).r;
  float added = GetAddedCover(GetViewDirection(middle));
  float open = 0.0;
  float above = 0.0;
  for (int i = 0; i < kSide * kSide; ++i) {
    vec2 place = (corner + (vec2(i % kSide, i / kSide) + 0.5) / float(kSide)) / pass_size;
    float sky = ReadBilinear(layers, place).r;
    float own = GetOwnOpacity(layers, place) * trust;
    float raised = smoothstep(-0.01, 0.02, GetViewDirection(place).y);
    open += raised * sky * (1.0 - own) * (1.0 - added);
    above += raised;
  }
  result = vec4(vec2(open, above) / float(kSide * kSide), GetMeanShade(middle), 1.0);
}
