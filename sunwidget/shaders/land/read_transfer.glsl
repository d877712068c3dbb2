// The light of any sun expected on a place of land, relative to a surface facing the sun: the scalar
// product of twelve shares of the place, predicted by the land network (analysis/depth/relief.py), with twelve functions
// of the sun's direction, after Sloan et al., "Precomputed Radiance Transfer for Real-Time Rendering in Dynamic,
// Low-Frequency Lighting Environments", SIGGRAPH 2002. The roots of the shares are stored in three stacked pictures.

uniform sampler2D transfer;

const float kLargestShare = 2.0;

vec4 ReadShares(vec2 place, int third) {
  ivec2 size = textureSize(transfer, 0) / ivec2(1, 3);
  vec2 at = clamp(place * vec2(size) - 0.5, vec2(0.0), vec2(size) - 1.0);
  ivec2 low = ivec2(floor(at));
  ivec2 high = min(low + 1, size - 1);
  vec2 share = at - vec2(low);
  ivec2 first = ivec2(0, third * size.y);
  vec4 top = mix(texelFetch(transfer, first + low, 0), texelFetch(transfer, first + ivec2(high.x, low.y), 0), share.x);
  vec4 bottom = mix(texelFetch(transfer, first + ivec2(low.x, high.y), 0), texelFetch(transfer, first + high, 0), share.x);
  vec4 code = 2.0 * mix(top, bottom, share.y) - 1.0;
  return kLargestShare * code * abs(code);
}

struct Transfer {
  vec4 first;
  vec4 second;
  vec4 third;
};

Transfer ReadTransfer(vec2 place) {
  return Transfer(ReadShares(place, 0), ReadShares(place, 1), ReadShares(place, 2));
}

// Light of a sun in this direction, in world coordinates.
float GetSunlight(Transfer land, vec3 sun) {
  float height = max(sun.y, 0.0);
  float low = sqrt(height);
  float along = sun.x * sun.x - sun.z * sun.z;
  float across = 2.0 * sun.x * sun.z;
  float light = dot(land.first, vec4(1.0, sun.x, sun.z, height))
      + dot(land.second, vec4(low, sun.x * low, sun.z * low, along))
      + dot(land.third, vec4(across, along * height, across * height, height * height));
  return clamp(light, 0.0, 1.0);
}

// Light of a uniform sky: the mean over all directions.
float GetOpenness(Transfer land) {
  float mean = dot(land.first, vec4(2.0, 0.0, 0.0, 1.0)) + 4.0 / 3.0 * land.second.x + 2.0 / 3.0 * land.third.w;
  return clamp(mean, 0.0, 1.0);
}
