// The user supplies the render mesh, so its type is part of the public interface.
#pragma once

#include <weft/mesh.h>
