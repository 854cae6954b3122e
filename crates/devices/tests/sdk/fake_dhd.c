/* A stand-in for libdhd: one device, whose state a test sets and whose force it looks at. */
static int plugged = 1, opened, enabled, force_when_enabled = -1;
static double position[3], force[3];
static unsigned buttons, watchdog, since; /* since: times 125 us since the last force */

int fake_set(int is_plugged, double x, double y, double z, unsigned mask) {
    plugged = is_plugged;
    position[0] = x, position[1] = y, position[2] = z;
    buttons = mask;
    return 0;
}

/* Force along its x, y and z; motors on; device open. */
int fake_get(double *out) {
    for (int n = 0; n < 3; n++) out[n] = force[n];
    out[3] = enabled, out[4] = opened, out[5] = force_when_enabled, out[6] = watchdog;
    return 0;
}

/* A millisecond passes: the watchdog may take the force off. */
int fake_pass(void) {
    since += 8;
    if (watchdog && since > watchdog) force[0] = force[1] = force[2] = 0;
    return 0;
}

int dhdGetDeviceCount(void) { return plugged; }
int dhdOpen(void) { return plugged ? (opened = 1, 0) : -1; }
int dhdClose(char id) { opened = 0; return id == 0 ? 0 : -1; }
int dhdEnableForce(unsigned char on, char id) {
    if (on) force_when_enabled = force[0] != 0 || force[1] != 0 || force[2] != 0;
    enabled = on;
    return id == 0 ? 0 : -1;
}
int dhdGetPosition(double *x, double *y, double *z, char id) {
    *x = position[0], *y = position[1], *z = position[2];
    return plugged && id == 0 ? 0 : -1;
}
int dhdSetForce(double x, double y, double z, char id) {
    if (!plugged || id != 0) return -1;
    force[0] = x, force[1] = y, force[2] = z, since = 0;
    return 2; /* a remark: a motor is saturated */
}
unsigned dhdGetButtonMask(char id) { return id == 0 ? buttons : 0; }
const char *dhdErrorGetLastStr(void) { return plugged ? "no error" : "no device found"; }
int dhdSetWatchdog(unsigned char duration, char id) { watchdog = duration; return id == 0 ? 0 : -1; }
