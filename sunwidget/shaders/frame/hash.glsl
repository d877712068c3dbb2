// Integer hash, the same to the bit on every host: PCG (O'Neill 2014), the best hash at its
// cost (Jarzynski & Olano 2020).
uint Hash(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}
