// Keeps a loop a loop. Drivers unroll loops of a known number of steps, and then take long to compile their look-ups.

// `steps` itself, which a compiler cannot know, since it does not know `size`.
int GetSteps(int steps, vec2 size) {
  return steps + min(int(size.x), 0);
}
