// Means over the picture on a grid of taps: of dry land, and of the clouds in the visible sky.

#include "land/read_land_depth.glsl"
#include "land/relief.glsl"

uniform sampler2D land_depth;
uniform sampler2D surface;

const int kColumns = 24;
const int kRows = 16;
const int kTaps = kColumns * kRows;

vec2 GetTap(int i) {
  return (vec2(i % kColumns, i / kColumns) + 0.5) / vec2(kColumns, kRows);
}

// Share of a place that is land but not water, which reflects the sun elsewhere.
float GetDryLand(vec2 place) {
  return ReadLandDepth(land_depth, place).g * (1.0 - ReadPicture(surface, place).g);
}

// Share of the sky that clouds cover beyond a veil of this opacity.
float GetMeanCover(sampler2D openness, float veil) {
  vec2 sky = vec2(0.0, 0.5);
  for (int i = 0; i < kTaps; ++i) {
    float here = 1.0 - ReadLandDepth(land_depth, GetTap(i)).g;
    sky += here * vec2(max(ReadBilinear(openness, GetTap(i)).b - veil, 0.0) / max(1.0 - veil, 0.1), 1.0);
  }
  return sky.x / sky.y;
}
