// Selects the shader of a pass with cloud edits: 0 for the photo's own clouds, 1 for edited ones.

#include "clouds/cloud_edit.glsl"
#include "frame/part.glsl"

void main() {
  SetPart(IsCloudEdited() ? 1 : 0);
}
