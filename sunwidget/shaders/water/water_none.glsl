// Where there is no water (water_parts.glsl), nobody asks what lies behind it.

out vec4 result;

void main() {
  result = vec4(0.0);
}
