// The land's log-depth map of land_depth.glsl: r the level, g the share of land. A march reads it dozens
// of times, so a texel also holds its right, lower and diagonal neighbors: a bilinear read is one fetch.

// Level and land in one number: beside the land's 8 bits 16 remain for the level, steps of a 4000th of an octave.
vec4 PackLandDepth(vec4 level, vec4 land) {
  return floor(255.0 * clamp(land, 0.0, 1.0) + 0.5) + min(level, vec4(0.9999));
}

vec2 ReadLandDepth(sampler2D image, vec2 place) {
  vec2 size = vec2(textureSize(image, 0));
  vec2 at = clamp(place * size - 0.5, vec2(0.0), size - 1.0);
  vec2 low = floor(at);
  vec2 share = at - low;
  vec4 packed_four = texelFetch(image, ivec2(low), 0);
  vec4 land = floor(packed_four);
  vec4 level = packed_four - land;
  vec4 near = vec4((1.0 - share.x) * (1.0 - share.y), share.x * (1.0 - share.y),
                   (1.0 - share.x) * share.y, share.x * share.y);
  return vec2(dot(near, level), dot(near, land) / 255.0);
}
