// How near a direction is to the sun.

const float kRoundSun = 0.05;  // 1 - cosine of 18 degrees

// 1 at the sun, and almost 0 at 40 degrees from it.
float GetNearness(float cosine) {
  return exp((cosine - 1.0) / kRoundSun);
}
