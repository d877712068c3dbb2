// The land's log-depth at an eighth of the size, for the march of shadow.glsl: r the level, g how
// much of the texel is land. Drawn once a photo.

#include "lib/picture.glsl"

uniform sampler2D surface;
uniform sampler2D layers;
uniform vec2 pass_size;

out vec4 result;

const int kSamples = 4;

void main() {
  float level = 0.0;
  float land = 0.0;
  float weight = 1e-6;
  for (int row = 0; row < kSamples; ++row) {
    for (int column = 0; column < kSamples; ++column) {
      vec2 inside = (vec2(column, row) + 0.5) / float(kSamples) - 0.5;
      vec2 place = (gl_FragCoord.xy + inside) / pass_size;
      // The sky of a texel has its depth from the land beside it: only land counts where there is some.
      float here = 1.0 - ReadPicture(layers, place).r;
      level += (here + 1e-6) * ReadPicture(surface, place).a;
      weight += here + 1e-6;
      land += here;
    }
  }
  result = vec4(level / weight, land / float(kSamples * kSamples), 0.0, 1.0);
}
