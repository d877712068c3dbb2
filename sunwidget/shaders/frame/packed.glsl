// Up to three 8-bit maps in one float of a texel, exactly: floats hold integers below 2^24.

float PackLevels(vec3 levels) {
  return dot(floor(levels * 255.0 + 0.5), vec3(1.0, 256.0, 65536.0));
}

vec3 UnpackLevels(float code) {
  return floor(256.0 * fract(code / vec3(256.0, 65536.0, 16777216.0))) / 255.0;
}

// A second map in the last 3 bits of the first level, which keeps 5.
float PackSecond(float first, float second) {
  return dot(floor(vec2(31.0, 7.0) * vec2(first, second) + 0.5), vec2(8.0, 1.0)) / 255.0;
}

float UnpackSecond(float code) {
  return fract(code / 8.0) * 8.0 / 7.0;
}
