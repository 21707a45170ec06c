// What a desktop does to a window and xdotool does not: asks it to close, and drops files on it (XDND,
// version 5).
//   x_client close WINDOW
//   x_client drop WINDOW FILE ...
// Exit status 0 once the message is sent, or the window has taken the files; else 1, with a line that says
// why.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

namespace {

constexpr std::chrono::seconds kPatience{60};

class Client {
public:
    Client(Display* display, Window target)
        : mDisplay(display),
          mTarget(target),
          mOwn(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)) {}

    void close() {
        send("WM_PROTOCOLS", static_cast<long>(atom("WM_DELETE_WINDOW")), CurrentTime, 0, 0);
        XSync(mDisplay, False);
    }

    // False where the window takes no drops, refuses this one, or says nothing for long.
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

    // False where nobody has copied anything.
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
            constexpr long kMost = 1 << 16;  // of four bytes
            XGetWindowProperty(mDisplay, mOwn, event.xselection.property, 0, kMost, True, AnyPropertyType,
                               &type, &bits, &bytes, &rest, &text);
            if (text) std::fwrite(text, 1, bytes, stdout);
            if (text) XFree(text);
            return bytes > 0;
        }
        return false;
    }

private:
    // False once it took too long.
    bool next(XEvent& event) const {
        while (XPending(mDisplay) == 0) {
            if (std::chrono::steady_clock::now() > mEnd) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return XNextEvent(mDisplay, &event), true;
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
    if (what != "drop" || count < 4) return fail("expected close WINDOW, drop WINDOW FILE ..., or copied");
    std::string uris;
    for (int n = 3; n < count; ++n) uris += std::string("file://") + words[n] + "\r\n";
    return client.drop(uris) ? 0 : fail("the window did not take the files");
}
