// Luminance, and the code values of display light.

const vec3 kRec709Luminance = vec3(0.2126, 0.7152, 0.0722);

float GetLuminance(vec3 color) {
  return dot(color, kRec709Luminance);
}

// IEC 61966-2-1 transfer function.
vec3 EncodeSrgb(vec3 light) {
  vec3 x = clamp(light, 0.0, 1.0);
  return mix(12.92 * x, 1.055 * pow(max(x, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), x));
}
