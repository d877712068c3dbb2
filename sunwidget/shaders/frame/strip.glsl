// Reading of picture-sized scene textures in frame-sized passes. A host may provide a texture as a strip: some
// rows of a large picture, where rows longer than the largest texture are cut into stacked
// pieces. All other passes read the whole picture (ReadPicture).

uniform vec4 picture_strip;  // first row, width and height of the picture, rows; texels, 0 = no strip

ivec2 GetPictureSize(sampler2D image) {
  return picture_strip.y > 0.0 ? ivec2(picture_strip.yz) : textureSize(image, 0);
}

// A texel of the picture, clamped at the edge.
vec4 FetchPixel(sampler2D image, ivec2 texel) {
  texel = clamp(texel, ivec2(0), GetPictureSize(image) - 1);
  if (picture_strip.y > 0.0) {
    int width = textureSize(image, 0).x;
    int height = int(picture_strip.w);
    int piece = int((float(texel.x) + 0.5) / float(width));
    texel.y = clamp(texel.y - int(picture_strip.x), 0, height - 1);
    texel += ivec2(-width, height) * piece;
  }
  return texelFetch(image, texel, 0);
}

// Like ReadPicture.
vec4 ReadPixel(sampler2D image, vec2 place) {
  return FetchPixel(image, ivec2(place * vec2(GetPictureSize(image))));
}
