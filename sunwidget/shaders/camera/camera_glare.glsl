// The camera's own glare around the sun: light that lens and sensor scatter over the whole picture, sky
// and land alike. It adds light of the sun's color: the glow in a deep blue sky is white.
// `glare_profile` (analysis/sun/camera_glare.py) is the profile for a sun in a well exposed picture.

uniform vec3 glare_profile;  // a (scene-linear luminance), b (degrees), c

const float kRayLength = 40.0;  // squared angle, in units of b, at which half of the rays' stretching is gone

// G(angle) = a / (1 + (angle / b)^2)^c. The chord stands in for the angle: they differ only where glare is gone.
// `rays` stretches it along the rays of a starburst, by this many stops (of the squared angle) close to the sun: the
// edges of an aperture of seven blades diffract light into fourteen directions (Hecht, Optics, ch. 10), and scratches on
// the glass into finer ones between.
float GetCameraGlare(vec3 view, vec3 sun, float rays) {
  vec3 chord = view - sun;
  float x = degrees(1.0) / max(glare_profile.y, 0.05);
  float square = x * x * dot(chord, chord);
  if (rays > 0.0) {
    vec3 right = normalize(vec3(sun.z, 0.0, -sun.x));
    float turn = atan(dot(chord, cross(sun, right)), dot(chord, right) + 1e-9);
    vec2 ray = 0.5 + 0.5 * cos(turn * vec2(14.0, 31.0) - vec2(0.4, 1.37));
    ray *= ray;
    ray *= vec2(ray.x, 0.35) * (0.7 + 0.3 * cos(3.0 * turn - 0.93));
    square *= exp2(rays * (0.3 - max(ray.x, ray.y)) / (1.0 + square / kRayLength));
  }
  return glare_profile.x * pow(1.0 + square, -glare_profile.z);
}

// A camera exposes for a visible sun, so its glare grows more slowly than the sun's light.
const float kSunOfProfile = 20.0;  // klx on the lens: a sun ten degrees high in clear air
const float kGlareGrowth = 0.35;

float GetGlareStrength(float illuminance) {
  return pow(max(illuminance, 1e-9) / kSunOfProfile, kGlareGrowth);
}

// Keeps the color of a sun's light, whose luminance is 1, no redder than `reddest`: cameras show as pale what burns.
vec3 LimitRed(vec3 color, vec3 reddest) {
  return vec3(min(color.r, reddest.r), max(color.gb, reddest.gb));
}

// Packs the sun's color into one float: shares of red and blue in 12 bits each.
float PackColor(vec3 color) {
  vec3 share = color / max(dot(color, vec3(1.0)), 1e-12);
  return floor(share.r * 4095.0 + 0.5) + 4096.0 * floor(share.b * 4095.0 + 0.5);
}

// Returns the color with luminance 1.
vec3 UnpackColor(float code) {
  float blue = floor(code / 4096.0);
  vec2 share = vec2(code - 4096.0 * blue, blue) / 4095.0;
  vec3 color = vec3(share.x, max(1.0 - share.x - share.y, 0.0), share.y);
  return color / max(dot(color, vec3(0.2126, 0.7152, 0.0722)), 1e-6);
}
