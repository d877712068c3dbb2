// Random numbers in [0, 1), a sequence for each pixel and sample: PCG (O'Neill 2014; as a hash of
// integers the best of its price, Jarzynski & Olano 2020), the same to the bit on every host.

uint random_state;

uint HashInteger(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

void StartRandom(uvec2 pixel, uint sequence) {
  random_state = HashInteger(pixel.x + HashInteger(pixel.y + HashInteger(sequence)));
}

float GetRandom() {
  random_state = random_state * 747796405u + 2891336453u;
  uint word = ((random_state >> ((random_state >> 28u) + 4u)) ^ random_state) * 277803737u;
  return float(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}
