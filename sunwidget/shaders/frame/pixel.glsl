// The pixel being drawn, with top-left origin on every host, and its noise.

#include "frame/frame_size.glsl"
#include "frame/hash.glsl"

uniform vec2 tile_origin;
uniform float canvas_flip;     // 1 when drawing to the browser's canvas, whose row 0 is at the bottom
uniform int output_transfer;   // 0 linear light, 1 sRGB
uniform float dither;          // half-width of the triangular dither, in levels of 1/255

out vec4 result;

vec2 GetPixel() {
  vec2 at = gl_FragCoord.xy;
  if (canvas_flip > 0.5) at.y = frame_size.y - at.y;
  return at + tile_origin;
}

float GetNoise(uvec2 at, uint channel) {
  return float(Hash(at.x + Hash(at.y + Hash(channel))) >> 8u) / 16777216.0;
}

// Triangular noise in [-1, 1] times `dither`, in code values.
float GetDither(vec2 pixel) {
  uvec2 at = uvec2(pixel);
  return dither / 255.0 * (GetNoise(at, 0u) - GetNoise(at, 1u));
}
