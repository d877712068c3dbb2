// Which shader draws a pass that knows clouds: 0 the one for a photo's own clouds, 1 that for edited ones.

#include "clouds/cloud_edit.glsl"
#include "frame/part.glsl"

void main() {
  SetPart(IsCloudEdited() ? 1 : 0);
}
