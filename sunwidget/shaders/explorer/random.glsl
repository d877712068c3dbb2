// Random numbers in [0, 1), one sequence per pixel and sample, by the generator that Hash is a step of.

#include "frame/hash.glsl"

uint random_state;

void StartRandom(uvec2 pixel, uint sequence) {
  random_state = Hash(pixel.x + Hash(pixel.y + Hash(sequence)));
}

float GetRandom() {
  uint drawn = Hash(random_state);
  random_state = random_state * 747796405u + 2891336453u;
  return float(drawn >> 8u) / 16777216.0;
}
