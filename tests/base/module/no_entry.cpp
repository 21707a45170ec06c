// A shared object that is no module.
int answer();
int answer() {
    return 42;
}
