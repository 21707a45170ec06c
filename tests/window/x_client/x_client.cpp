// What a desktop does to a window and xdotool does not: asks it to close, drops files on it (XDND, version
// 5), and asks whether it answers.
//   x_client close WINDOW
//   x_client drop WINDOW FILE ...
//   x_client turns WINDOW N
//   x_client rest WINDOW PROCESS
//   x_client copied
// Exit status 0 once the message is sent, the window has taken the files, it has gone round N times, or the
// program does nothing more; else 1, with a line that says why.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace {

constexpr std::chrono::seconds kPatience{300};  // the same as in tests/window/drive_window.sh

class Client {
public:
    Client(Display* display, Window target)
        : mDisplay(display),
          mTarget(target),
          mOwn(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)) {
        // Answers to pings, and ends of windows.
        XSelectInput(display, DefaultRootWindow(display), SubstructureNotifyMask);
    }

    void close() {
        send("WM_PROTOCOLS", static_cast<long>(atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0);
        XSync(mDisplay, False);
    }

    // Returns false where the window takes no drops, refuses this one, or says nothing for long.
    bool drop(const std::string& uris) {
        XSetSelectionOwner(mDisplay, atom("XdndSelection"), mOwn, CurrentTime);
        constexpr long kVersion = 5;
        const long source = static_cast<long>(mOwn), copy = static_cast<long>(atom("XdndActionCopy"));
        send("XdndEnter", source, kVersion << 24, static_cast<long>(atom("text/uri-list")), 0);
        int x = 0, y = 0;
        Window child = 0;
        XTranslateCoordinates(mDisplay, mTarget, DefaultRootWindow(mDisplay), 20, 20, &x, &y, &child);
        send("XdndPosition", source, 0, x << 16 | y, CurrentTime, copy);
        XEvent event;
        while (next(event)) {
            if (event.type == SelectionRequest) give(event.xselectionrequest, uris);
            if (event.type != ClientMessage) continue;
            const XClientMessageEvent& message = event.xclient;
            if (message.message_type == atom("XdndStatus")) {
                if ((message.data.l[1] & 1) == 0) return false;
                send("XdndDrop", source, 0, CurrentTime, 0);
            }
            if (message.message_type == atom("XdndFinished"))
                return message.data.l[1] != 0;  // GLFW tells the bytes
        }
        return false;
    }

    // A window answers a ping when it handles what happened to it, in the order in which it happened. Each
    // but the first is sent after such a time, and is answered at the next: between two answers is a whole
    // turn, in which the window has used what happened and was drawn. Returns false where the window is gone,
    // or does not answer.
    bool turns(int count) {
        for (int ping = 0; ping <= count; ++ping) {
            send("WM_PROTOCOLS", static_cast<long>(atom("_NET_WM_PING")), static_cast<long>(mOwn) + ping,
                 static_cast<long>(mTarget), 0);
            if (!pong(static_cast<long>(mOwn) + ping)) return false;
        }
        return true;
    }

    // Waits until none of the program's threads works, and the window has used what came of their work. A
    // thread that works runs or wants to, however busy the machine is; those that look for something now and
    // then do so more often than this one counts. False as for turns().
    bool rest(const std::string& process) {
        constexpr int kQuiet = 10;
        constexpr std::chrono::milliseconds kBetween{40};
        if (!turns(3)) return false;
        Threads before;
        for (int quiet = 0; std::chrono::steady_clock::now() < mEnd;) {
            const Threads now = threadsOf(process);
            const bool same = !now.othersWork && now.othersTicks == before.othersTicks;
            before = now;
            if (!same)
                quiet = 0;
            else if (!now.ownWorks)
                ++quiet;
            if (quiet > kQuiet) return true;
            if (quiet == kQuiet && !turns(3)) return false;
            std::this_thread::sleep_for(kBetween);
        }
        return false;
    }

    // Returns false where nobody has copied anything.
    bool copied() {
        XConvertSelection(mDisplay, atom("CLIPBOARD"), atom("UTF8_STRING"), atom("TEXT_TO_PRINT"), mOwn,
                          CurrentTime);
        XEvent event;
        while (next(event)) {
            if (event.type != SelectionNotify) continue;
            if (event.xselection.property == None) return false;
            Atom type = None;
            int bits = 0;
            unsigned long bytes = 0, rest = 0;
            unsigned char* text = nullptr;
            constexpr long kMost = 1 << 16;  // units of four bytes
            XGetWindowProperty(mDisplay, mOwn, event.xselection.property, 0, kMost, True, AnyPropertyType,
                               &type, &bits, &bytes, &rest, &text);
            if (text) std::fwrite(text, 1, bytes, stdout);
            if (text) XFree(text);
            return bytes > 0;
        }
        return false;
    }

private:
    // A program's window thread, and its others. Ticks of processor time.
    struct Threads {
        bool ownWorks = false, othersWork = false;
        long othersTicks = -1;
    };
    static Threads threadsOf(const std::string& process) {
        Threads threads;
        threads.othersTicks = 0;
        std::error_code code;
        for (std::filesystem::directory_iterator at("/proc/" + process + "/task", code), end;
             !code && at != end; at.increment(code)) {
            std::ifstream in(at->path() / "stat");
            std::string line;
            std::getline(in, line);
            const std::size_t name = line.rfind(") ");  // end of the name, which may have any letters
            if (name == std::string::npos) continue;
            std::istringstream fields(line.substr(name + 2));
            std::string state;
            fields >> state;
            constexpr int kBetween = 10;  // fields from there to the times
            std::string passed;
            for (int n = 0; n < kBetween; ++n) fields >> passed;
            long inProgram = 0, inSystem = 0;
            fields >> inProgram >> inSystem;
            const bool works = state == "R" || state == "D";
            if (at->path().filename() == process) {
                threads.ownWorks = works;
            } else {
                threads.othersWork = threads.othersWork || works;
                threads.othersTicks += inProgram + inSystem;
            }
        }
        return threads;
    }

    bool pong(long number) const {
        XEvent event;
        while (next(event)) {
            if (event.type == ClientMessage && event.xclient.message_type == atom("WM_PROTOCOLS") &&
                event.xclient.data.l[0] == static_cast<long>(atom("_NET_WM_PING")) &&
                event.xclient.data.l[1] == number)
                return true;
        }
        return false;
    }
    // Returns false once it took too long, or the window is gone.
    bool next(XEvent& event) const {
        while (XPending(mDisplay) == 0) {
            if (std::chrono::steady_clock::now() > mEnd) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        XNextEvent(mDisplay, &event);
        return event.type != DestroyNotify || event.xdestroywindow.window != mTarget;
    }
    Atom atom(const char* name) const { return XInternAtom(mDisplay, name, False); }
    void send(const char* type, long a, long b, long c, long d, long e = 0) const {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = mTarget;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        const long data[5] = {a, b, c, d, e};
        std::memcpy(event.xclient.data.l, data, sizeof data);
        XSendEvent(mDisplay, mTarget, False, NoEventMask, &event);
    }
    // The list of files, to who asks for it.
    void give(const XSelectionRequestEvent& wish, const std::string& uris) const {
        XChangeProperty(mDisplay, wish.requestor, wish.property, wish.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(uris.data()), static_cast<int>(uris.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = wish.requestor;
        event.xselection.selection = wish.selection;
        event.xselection.target = wish.target;
        event.xselection.property = wish.property;
        event.xselection.time = wish.time;
        XSendEvent(mDisplay, wish.requestor, False, NoEventMask, &event);
    }

    Display* mDisplay;
    Window mTarget, mOwn;
    std::chrono::steady_clock::time_point mEnd = std::chrono::steady_clock::now() + kPatience;
};

int fail(const char* why) {
    std::fprintf(stderr, "x_client: %s\n", why);
    return 1;
}

}  // namespace

int main(int count, char** words) {
    const std::string what = count > 1 ? words[1] : "";
    Display* const display = XOpenDisplay(nullptr);
    if (!display) return fail("there is no display");
    Client client(display, count > 2 ? std::strtoul(words[2], nullptr, 0) : None);
    if (what == "copied") return client.copied() ? 0 : fail("nothing was copied");
    if (what == "close" && count == 3) return client.close(), 0;
    if (what == "turns" && count == 4)
        return client.turns(std::atoi(words[3])) ? 0 : fail("the window does not answer");
    if (what == "rest" && count == 4)
        return client.rest(words[3]) ? 0 : fail("the program goes on working, or does not answer");
    if (what != "drop" || count < 4)
        return fail(
            "expected close WINDOW, drop WINDOW FILE ..., turns WINDOW N, rest WINDOW PROCESS, or copied");
    std::string uris;
    for (int n = 3; n < count; ++n) uris += std::string("file://") + words[n] + "\r\n";
    return client.drop(uris) ? 0 : fail("the window did not take the files");
}
