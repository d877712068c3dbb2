// Where the picture of the disc (disc.glsl) lies in the sky: a square in the plane that touches
// the sphere of directions at the sun.

uniform float sun_azimuth;
uniform float sun_elevation;
uniform float sun_size;

const float kDiscSpan = 1.5;

// Half the square's side, as the tangent of an angle.
float GetDiscReach() {
  return kDiscSpan * SUN_ANGULAR_RADIUS * max(sun_size, 0.05) + 1.5 / (camera_focal * frame_size.y);
}

vec3 GetDiscRight() {
  float azimuth = radians(sun_azimuth);
  return vec3(cos(azimuth), 0.0, -sin(azimuth));
}

vec3 GetDiscUp() {
  float azimuth = radians(sun_azimuth);
  float elevation = radians(sun_elevation);
  return vec3(-sin(elevation) * sin(azimuth), cos(elevation), -sin(elevation) * cos(azimuth));
}
