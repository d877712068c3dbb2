// Pixels without water (water_parts.glsl), where nothing reads the result.

out vec4 result;

void main() {
  result = vec4(0.0);
}
