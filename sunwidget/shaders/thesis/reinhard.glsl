// Reinhard et al. 2001, "Color Transfer between Images": matches mean and deviation in lαβ, here over
// sky pixels only (thesis 3.2.3), with statistics computed once at the photo's own sun.

const mat3 kLmsFromRgb = mat3(0.3811, 0.1967, 0.0241, 0.5783, 0.7244, 0.1288, 0.0402, 0.0782, 0.8444);
const mat3 kRgbFromLms = mat3(4.4679, -1.2186, 0.0497, -3.5873, 2.3809, -0.2439, 0.1193, -0.1624, 1.2045);

vec3 GetLalphabeta(vec3 rgb) {
  vec3 lms = log(max(kLmsFromRgb * rgb, vec3(1e-4))) / 2.302585093;
  return vec3((lms.x + lms.y + lms.z) / sqrt(3.0), (lms.x + lms.y - 2.0 * lms.z) / sqrt(6.0), (lms.x - lms.y) / sqrt(2.0));
}

vec3 GetRgbOfLalphabeta(vec3 lab) {
  float l = lab.x / sqrt(3.0);
  float a = lab.y / sqrt(6.0);
  float b = lab.z / sqrt(2.0);
  vec3 lms = vec3(l + a + b, l + a - b, l - 2.0 * a);
  return max(kRgbFromLms * pow(vec3(10.0), min(lms, vec3(2.0))), vec3(0.0));
}

// Eq. 2.10–2.11; a flat source has no deviation to scale by.
vec3 TransferColor(vec3 rgb, vec3 from_mean, vec3 from_deviation, vec3 to_mean, vec3 to_deviation) {
  vec3 scale = to_deviation / max(from_deviation, vec3(0.02));
  return GetRgbOfLalphabeta((GetLalphabeta(rgb) - from_mean) * scale + to_mean);
}
