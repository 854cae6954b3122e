// A double: all is in one.
#include <H3D/H3DHapticsRendererNode.h>
