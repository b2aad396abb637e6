// The drawn mesh is the one that a user gives: its type is part of the public interface.
#pragma once

#include <weft/mesh.h>
