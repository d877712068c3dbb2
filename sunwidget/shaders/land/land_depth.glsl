// The land's log-depth at an eighth of the size, for the march of shadow.glsl, in the layout of
// land/read_land_depth.glsl. Drawn once per photo.

#include "frame/picture.glsl"
#include "land/read_land_depth.glsl"

uniform sampler2D surface;
uniform sampler2D layers;
uniform vec2 pass_size;

out vec4 result;

const int kSamples = 4;

vec2 GetLandDepth(vec2 middle) {
  float level = 0.0;
  float land = 0.0;
  float weight = 1e-6;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      vec2 inside = (vec2(column, row) + 0.5) / float(kSamples) - 0.5;
      vec2 place = (middle + inside) / pass_size;
      // A texel's sky takes its depth from the land beside it, so only land counts where there is any.
      float here = 1.0 - ReadPicture(layers, place).r;
      level += (here + 1e-6) * ReadPicture(surface, place).a;
      weight += here + 1e-6;
      land += here;
    }
  }
  return vec2(level / weight, land / float(kSamples * kSamples));
}

void main() {
  vec2 here = gl_FragCoord.xy;
  vec2 next = min(here + 1.0, pass_size - 0.5);
  vec2 right = GetLandDepth(vec2(next.x, here.y));
  vec2 below = GetLandDepth(vec2(here.x, next.y));
  vec2 beyond = GetLandDepth(next);
  vec2 own = GetLandDepth(here);
  result = PackLandDepth(vec4(own.x, right.x, below.x, beyond.x), vec4(own.y, right.y, below.y, beyond.y));
}
