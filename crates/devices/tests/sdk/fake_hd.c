/* A stand-in for libHD: one device, whose scheduler a test drives tick by tick. */
typedef unsigned (*callback_type)(void *);
typedef struct { unsigned code; int internal; unsigned device; } error_info;

static callback_type callback;
static void *data;
static int running, in_frame, enabled, misuse;
static unsigned error;
static double position[3], force[3];
static int buttons;

int fake_set(unsigned code, double x, double y, double z, int mask) {
    error = code;
    position[0] = x, position[1] = y, position[2] = z;
    buttons = mask;
    return 0;
}

/* Ticks of the scheduler; how many were carried out. */
int fake_run(int ticks) {
    int n = 0;
    while (n < ticks && running && callback) {
        if (!callback(data)) callback = 0;
        n++;
    }
    return n;
}

int fake_get(double *out) {
    for (int n = 0; n < 3; n++) out[n] = force[n];
    out[3] = enabled, out[4] = running, out[5] = misuse;
    return 0;
}

unsigned hdInitDevice(const char *name) { return error || name ? 0xFFFFFFFFu : 0; }
void hdDisableDevice(unsigned device) { enabled = 0, misuse |= device != 0; }
void hdEnable(unsigned what) { enabled = what == 0x4000; }
void hdStartScheduler(void) { running = 1; }
void hdStopScheduler(void) { running = 0; }
unsigned long hdScheduleAsynchronous(callback_type f, void *p, unsigned short priority) {
    callback = f, data = p, misuse |= running || !priority;
    return 7;
}
void hdUnschedule(unsigned long handle) { callback = 0, misuse |= handle != 7; }
void hdBeginFrame(unsigned device) { misuse |= in_frame || device != 0, in_frame = 1; }
void hdEndFrame(unsigned device) { misuse |= !in_frame || device != 0, in_frame = 0; }
void hdGetDoublev(unsigned what, double *out) {
    misuse |= what != 0x2050 || !in_frame;
    for (int n = 0; n < 3; n++) out[n] = position[n];
}
void hdGetIntegerv(unsigned what, int *out) { misuse |= what != 0x2000 || !in_frame, *out = buttons; }
void hdSetDoublev(unsigned what, const double *in) {
    misuse |= what != 0x2700 || !in_frame;
    for (int n = 0; n < 3; n++) force[n] = in[n];
}
error_info hdGetError(void) { error_info info = {error, 0, 0}; return info; }
