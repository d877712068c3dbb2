// Up to three 8-bit maps in one float of a texel, exactly: floats hold integers below 2^24.

float PackLevels(vec3 levels) {
  return dot(floor(levels * 255.0 + 0.5), vec3(1.0, 256.0, 65536.0));
}

vec3 UnpackLevels(float code) {
  float high = floor(code / 65536.0);
  float rest = code - 65536.0 * high;
  float middle = floor(rest / 256.0);
  return vec3(rest - 256.0 * middle, middle, high) / 255.0;
}
