// The land's orientation and its sunlight in the photo (analysis/depth/relief.py): R and G the normal's right and up
// components in camera coordinates, B the share of the sun that reaches it past land, A the cosine between normal and
// sun where it does.

uniform sampler2D relief;

struct Relief {
  vec3 normal;     // in world coordinates
  float lit;
  float facing;
};

Relief ReadRelief(vec2 place) {
  vec4 code = ReadBilinear(relief, place);
  vec2 slope = 2.0 * code.rg - 1.0;
  // Visible surfaces face the camera.
  vec3 normal = normalize(vec3(slope.x, -slope.y, -sqrt(max(1.0 - dot(slope, slope), 1e-3))));
  vec3 world = vec3(dot(normal, camera_right), dot(normal, camera_up), dot(normal, camera_forward));
  return Relief(world, code.b, code.a);
}

// Cosine of the angle between two suns from which their shadows are unrelated: 10 degrees.
const float kShadowsUnrelated = 0.985;

// Weight of the moved sun's shadows, 0 to 1: a sun that has hardly moved keeps the photo's.
float GetShadowChange(vec3 sun_before, vec3 sun) {
  return all(equal(sun_before, sun)) ? 0.0 : 1.0 - smoothstep(kShadowsUnrelated, 1.0, dot(sun_before, sun));
}
