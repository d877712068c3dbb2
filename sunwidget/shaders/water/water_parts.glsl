// Selects the shader that draws a pixel of the water: 0 water_none, 1 water_calm, 2 water_behind itself. What the
// first two omit is multiplied by zero (sky_behind.glsl, water/water.glsl).

#include "frame/picture.glsl"
#include "frame/strip.glsl"
#include "frame/part.glsl"

uniform sampler2D layers;
uniform sampler2D surface;
uniform vec2 tile_origin;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  float matte = ReadPixel(layers, place).r;
  vec2 marks = ReadPixel(surface, place).gb;
  bool wet = marks.x > 0.2 && matte < 0.2;
  // Along a shore that shows some sky, the light behind it must also be free of glints.
  SetPart(!wet ? 0 : marks.y == 0.0 && matte == 0.0 ? 1 : 2);
}
