// The land's log-depth at an eighth of the size, for the march of shadow.glsl, in the layout of
// land/read_land_depth.glsl. Drawn once per photo.

#include "frame/picture.glsl"
#include "frame/rolled.glsl"
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
  int samples = GetSteps(kSamples * kSamples, pass_size);
  for (int i = 0; i < samples; ++i) {
    vec2 inside = (vec2(i % kSamples, i / kSamples) + 0.5) / float(kSamples) - 0.5;
    vec2 place = (middle + inside) / pass_size;
    // A texel's sky takes its depth from the land beside it, so only land counts where there is any.
    float here = 1.0 - ReadPicture(layers, place).r;
    level += (here + 1e-6) * ReadPicture(surface, place).a;
    weight += here + 1e-6;
    land += here;
  }
  return vec2(level / weight, land / float(kSamples * kSamples));
}

void main() {
  vec4 level;
  vec4 land;
  for (int i = 0; i < GetSteps(4, pass_size); ++i) {
    vec2 depth = GetLandDepth(min(gl_FragCoord.xy + vec2(i % 2, i / 2), pass_size - 0.5));
    level[i] = depth.x;
    land[i] = depth.y;
  }
  result = PackLandDepth(level, land);
}
