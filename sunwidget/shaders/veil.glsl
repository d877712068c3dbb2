// What the camera and the air between put before the whole picture: glow, light shafts and lens
// flare, now minus with the photo's own sun. Soft, so a quarter of the size is enough.

#include "lib/picture.glsl"

uniform vec2 pass_size;

out vec4 result;

void main() {
  result = vec4(0.0);
}
