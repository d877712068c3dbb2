// How freely the sun shines through each part of the picture, for the light shafts: r is 1 in clear
// sky and 0 on land or thick cloud, times g, 1 above the horizon: what lies below it stands before no
// sun and tells nothing. Shafts are soft: an eighth of the size is enough.

#include "lib/picture.glsl"
#include "lib/cloud_cover.glsl"

uniform sampler2D layers;
uniform sampler2D surface;
uniform vec2 pass_size;

out vec4 result;

const int kSide = 3;  // samples a side of each texel

void main() {
  vec2 corner = gl_FragCoord.xy - 0.5;
  vec2 middle = gl_FragCoord.xy / pass_size;
  // The old sun's glare whitens the sky, but no cloud need be there.
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
  result = vec4(vec2(open, above) / float(kSide * kSide), 0.0, 1.0);
}
