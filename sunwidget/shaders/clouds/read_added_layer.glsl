// Reads the map of added_layer.glsl, averaged over about a texel: neighbors hold parts of one march.

uniform sampler2D added_layer;

vec4 ReadAddedLayer(vec2 place) {
  vec2 half_texel = 0.5 / vec2(textureSize(added_layer, 0));
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    sum += 0.25 * ReadBilinear(added_layer, place + (2.0 * vec2(i & 1, i >> 1) - 1.0) * half_texel);
  }
  return sum;
}
