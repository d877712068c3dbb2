// Reading land_light.glsl's map in the frame: four texels, weighed by how alike their depth is, so
// that the light of far land does not bleed into what stands before it.

uniform sampler2D land_light;

vec3 GetLandLight(vec2 place, float log_depth) {
  vec2 size = vec2(textureSize(land_light, 0));
  vec2 at = clamp(place * size - 0.5, vec2(0.0), size - 1.0);
  ivec2 low = ivec2(floor(at));
  ivec2 high = min(low + 1, ivec2(size) - 1);
  vec2 share = at - vec2(low);
  vec4 a = texelFetch(land_light, low, 0);
  vec4 b = texelFetch(land_light, ivec2(high.x, low.y), 0);
  vec4 c = texelFetch(land_light, ivec2(low.x, high.y), 0);
  vec4 d = texelFetch(land_light, high, 0);
  // A sixteenth of the scale is a factor of two.
  vec4 apart = 32.0 * abs(vec4(a.a, b.a, c.a, d.a) - log_depth);
  vec4 near = vec4((1.0 - share.x) * (1.0 - share.y), share.x * (1.0 - share.y),
                   (1.0 - share.x) * share.y, share.x * share.y);
  vec4 weight = (near + 1e-4) / (1.0 + apart * apart * apart * apart);
  weight /= weight.x + weight.y + weight.z + weight.w;
  // From one of them, so that four equal ones give just that, to the bit.
  return a.rgb + weight.y * (b.rgb - a.rgb) + weight.z * (c.rgb - a.rgb) + weight.w * (d.rgb - a.rgb);
}
