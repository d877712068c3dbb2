// Reads the maps of land_shade.glsl and land_sunshine.glsl in the frame: four texels, weighted by the similarity of
// their depth, so that the light of far land does not bleed into things in front of it. The two maps are mixed by
// the sun's share of the photo's light here.

#include "land/relief.glsl"

uniform sampler2D land_shade;
uniform sampler2D land_sunshine;

vec3 GetLandLight(vec2 place, float log_depth) {
  vec2 size = vec2(textureSize(land_shade, 0));
  vec2 at = clamp(place * size - 0.5, vec2(0.0), size - 1.0);
  ivec2 low = ivec2(floor(at));
  ivec2 high = min(low + 1, ivec2(size) - 1);
  vec2 share = at - vec2(low);
  ivec2 right = ivec2(high.x, low.y);
  ivec2 below = ivec2(low.x, high.y);
  vec4 a = texelFetch(land_shade, low, 0);
  vec4 b = texelFetch(land_shade, right, 0);
  vec4 c = texelFetch(land_shade, below, 0);
  vec4 d = texelFetch(land_shade, high, 0);
  // A sixteenth of the scale is a factor of two.
  vec4 apart = 32.0 * abs(vec4(a.a, b.a, c.a, d.a) - log_depth);
  vec4 near = vec4((1.0 - share.x) * (1.0 - share.y), share.x * (1.0 - share.y),
                   (1.0 - share.x) * share.y, share.x * share.y);
  vec4 weight = (near + 1e-4) / (1.0 + apart * apart * apart * apart);
  weight /= weight.x + weight.y + weight.z + weight.w;
  // As differences from one texel, so that four equal ones give exactly their value.
  vec3 shade = a.rgb + weight.y * (b.rgb - a.rgb) + weight.z * (c.rgb - a.rgb) + weight.w * (d.rgb - a.rgb);
  a = texelFetch(land_sunshine, low, 0);
  b = texelFetch(land_sunshine, right, 0);
  c = texelFetch(land_sunshine, below, 0);
  d = texelFetch(land_sunshine, high, 0);
  vec4 sunny = a + weight.y * (b - a) + weight.z * (c - a) + weight.w * (d - a);
  float lit = ReadBilinear(relief, place).b;
  float of_sun = lit * sunny.a / (1.0 - lit + lit * sunny.a);
  return shade + of_sun * (sunny.rgb - shade);
}
