// A helper program that somebody has taken over (tests/support/lying_helper.h): says that it is of this
// build, then whatever the file STEREONAV_TEST_ANSWER holds, and stays. Without such a file it ends by a
// signal once it is asked; with an empty one it says nothing and does not read either.
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include "engine/base/helper_socket.h"
#include "engine/base/module.h"

namespace {

bool say(const std::string& bytes) {
    for (std::size_t said = 0; said < bytes.size();) {
        const ssize_t written = write(STDIN_FILENO, bytes.data() + said, bytes.size() - said);
        if (written <= 0) return false;
        said += static_cast<std::size_t>(written);
    }
    return true;
}

bool hear(char* to, std::size_t count) {
    while (count > 0) {
        const ssize_t got = read(STDIN_FILENO, to, count);
        if (got <= 0) return false;
        to += got;
        count -= static_cast<std::size_t>(got);
    }
    return true;
}

}  // namespace

int main() {
    alarm(3600);  // should nobody end it
    const std::string build = stereonav::moduleBuild();
    stereonav::HelperHead head{build.size()};
    if (!say(std::string(reinterpret_cast<const char*>(&head), sizeof head) + build)) return 1;
    const char* const name = std::getenv("STEREONAV_TEST_ANSWER");
    std::ifstream file(name ? name : "", std::ios::binary);
    std::ostringstream answer;
    answer << file.rdbuf();
    if (!file.is_open() || !answer.str().empty()) {
        if (!hear(reinterpret_cast<char*>(&head), sizeof head)) return 1;
        std::string request(head.bytes, '\0');
        if (!hear(request.data(), request.size())) return 1;
        if (!file.is_open()) std::raise(SIGKILL);
        if (!say(answer.str())) return 1;
    }
    for (;;) pause();
}
