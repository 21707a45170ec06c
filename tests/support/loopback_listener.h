// Listens on this machine's loopback and counts connections, so that a test sees whether anything has
// connected to an address in a file.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "tests/support/wait_for.h"

namespace stereonav::test {

class LoopbackListener {
public:
    LoopbackListener() : mSocket(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in place = onLoopback(0);
        socklen_t size = sizeof place;
        EXPECT_EQ(bind(mSocket, reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
        EXPECT_EQ(listen(mSocket, 64), 0);
        EXPECT_EQ(getsockname(mSocket, reinterpret_cast<sockaddr*>(&place), &size), 0);
        mPort = ntohs(place.sin_port);
        mThread = std::thread([this] { run(); });
    }
    ~LoopbackListener() {
        shutdown(mSocket, SHUT_RDWR);  // ends the wait for the next connection
        mThread.join();
        close(mSocket);
    }
    LoopbackListener(const LoopbackListener&) = delete;
    LoopbackListener& operator=(const LoopbackListener&) = delete;

    int port() const { return mPort; }
    std::string address(const std::string& of) const {
        return "http://127.0.0.1:" + std::to_string(mPort) + "/" + of;
    }

    // Returns how many others have connected since the last call. It connects itself, and is accepted after
    // those who came before: that also shows that it listens.
    int connections() {
        const int own = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in from = onLoopback(0);
        socklen_t size = sizeof from;
        EXPECT_EQ(bind(own, reinterpret_cast<sockaddr*>(&from), sizeof from), 0);
        EXPECT_EQ(getsockname(own, reinterpret_cast<sockaddr*>(&from), &size), 0);
        mOwnPort = ntohs(from.sin_port);  // before it is seen there
        const int before = mOwn;
        const sockaddr_in place = onLoopback(mPort);
        EXPECT_EQ(connect(own, reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
        EXPECT_TRUE(waitFor([&] { return mOwn > before; })) << "nobody listens";
        close(own);
        return mOthers.exchange(0);
    }

private:
    static sockaddr_in onLoopback(int port) {
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_port = htons(static_cast<std::uint16_t>(port));
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        return place;
    }

    void run() {
        while (true) {
            sockaddr_in from{};
            socklen_t size = sizeof from;
            const int client = accept(mSocket, reinterpret_cast<sockaddr*>(&from), &size);
            if (client < 0) return;
            ++(ntohs(from.sin_port) == mOwnPort ? mOwn : mOthers);
            close(client);
        }
    }

    int mSocket, mPort = 0;
    std::atomic<int> mOwn = 0, mOthers = 0, mOwnPort = 0;
    std::thread mThread;
};

}  // namespace stereonav::test
