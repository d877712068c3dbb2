// Position of the disc's picture (sun_disc.glsl) on the sphere: a square around the sun, in the
// plane tangent to the sphere there, which contains the disc and its soft rim.

uniform float sun_azimuth;
uniform float sun_elevation;
uniform float sun_size;  // diameter in units of the true one

// Half the square's side, radians.
float GetDiscReach() {
  return kSunAngularRadius * sun_size + 1.5 * GetPixelAngle();
}

vec3 GetDiscRight() {
  return vec3(cos(radians(sun_azimuth)), 0.0, -sin(radians(sun_azimuth)));
}

vec3 GetDiscUp() {
  return GetSunDirection(sun_azimuth, sun_elevation + 90.0);
}
