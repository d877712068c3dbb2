// Gradient noise (Perlin 2002, "Improving noise") on integer hashes, the same on every host.

#include "frame/hash.glsl"

float GetGradient(ivec3 cell, vec3 offset) {
  uint hash = Hash(uint(cell.x) * 2378934083u ^ uint(cell.y) * 3625334849u ^ uint(cell.z) * 3407524639u);
  vec3 gradient = vec3(hash & 1023u, (hash >> 10u) & 1023u, (hash >> 20u) & 1023u) / 511.5 - 1.0;
  return dot(gradient, offset);
}

// Mean 0, deviation 0.19; cells of size 1.
float GetNoise(vec3 p) {
  vec3 low = floor(p);
  ivec3 cell = ivec3(low);
  vec3 f = p - low;
  vec3 share = f * f * f * (f * (6.0 * f - 15.0) + 10.0);
  vec4 near = vec4(GetGradient(cell, f),
                   GetGradient(cell + ivec3(1, 0, 0), f - vec3(1.0, 0.0, 0.0)),
                   GetGradient(cell + ivec3(0, 1, 0), f - vec3(0.0, 1.0, 0.0)),
                   GetGradient(cell + ivec3(1, 1, 0), f - vec3(1.0, 1.0, 0.0)));
  vec4 far = vec4(GetGradient(cell + ivec3(0, 0, 1), f - vec3(0.0, 0.0, 1.0)),
                  GetGradient(cell + ivec3(1, 0, 1), f - vec3(1.0, 0.0, 1.0)),
                  GetGradient(cell + ivec3(0, 1, 1), f - vec3(0.0, 1.0, 1.0)),
                  GetGradient(cell + ivec3(1, 1, 1), f - vec3(1.0, 1.0, 1.0)));
  vec4 rows = mix(near, far, share.z);
  vec2 pair = mix(rows.xz, rows.yw, share.x);
  return mix(pair.x, pair.y, share.y);
}
