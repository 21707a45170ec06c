#include "engine/base/free_memory.h"

#include <malloc.h>

namespace stereonav {

void giveBackFreeMemory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

}  // namespace stereonav
