// How the land lies and what light falls on it in the photo (analysis/depth/relief.py): R and G the normal's right and
// up in camera coordinates, B what of the sun reaches it past land, A the cosine between normal and sun where it does.

uniform sampler2D relief;

struct Relief {
  vec3 normal;     // in world coordinates
  float lit;
  float facing;
};

Relief ReadRelief(vec2 place) {
  vec4 code = ReadBilinear(relief, place);
  vec2 slope = 2.0 * code.rg - 1.0;
  // What is seen faces the camera.
  vec3 normal = normalize(vec3(slope.x, -slope.y, -sqrt(max(1.0 - dot(slope, slope), 1e-3))));
  vec3 world = vec3(dot(normal, camera_right), dot(normal, camera_up), dot(normal, camera_forward));
  return Relief(world, code.b, code.a);
}

// Cosine of the angle between two suns of which the one's shadows say nothing about the other's: 10 degrees.
const float kOtherShadows = 0.985;

// How far the shadows are another sun's: one that has hardly moved leaves them where the photo has them.
float GetOtherShadows(vec3 sun_before, vec3 sun) {
  return all(equal(sun_before, sun)) ? 0.0 : 1.0 - smoothstep(kOtherShadows, 1.0, dot(sun_before, sun));
}
