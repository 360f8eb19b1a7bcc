#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""watch.py [--frames N] [--keys FRAME:MASK,...] [--shot OUT.ppm] PROGRAM.elf [ARGUMENT...]

Runs the kernel image of a program that shows frames on QEMU's Raspberry Pi Zero, as a debugger does: it stops wherever the
program asks for its keys. Then the last frame is on the screen, and the levels of pins are set for the next; KEYS are masks
(enum display_key) of keys that are held from that frame on. Prints the CRC-32 of what the screen shows after each of N frames,
rows of RGB565 from the top. That is the page which the firmware was told to show; QEMU's own screen, which shows the first page
only, must agree with it whenever it is that one. With --shot it writes that screen as it is when the program has asked for
keys N times more than at its start.
"""
import argparse
import os
import struct
import subprocess
import sys
import tempfile
import zlib

PINS = {1: 6, 2: 19, 4: 5, 8: 26, 16: 13, 32: 20}       # enum display_key: the pin of display.c that is pulled to ground
SET_PINS, CLEAR_PINS = 0x2020001C, 0x20200028


class Debugger:
    """The remote protocol of GDB over QEMU's standard input and output."""

    def __init__(self, command):
        self.machine = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def ask(self, text):
        data = text.encode()
        self.machine.stdin.write(b"$%s#%02x" % (data, sum(data) % 256))
        self.machine.stdin.flush()
        return self.answer()

    def answer(self):
        byte = self.byte()
        while byte != b"$":
            byte = self.byte()
        text = b""
        while (byte := self.byte()) != b"#":
            text += byte
        self.byte(), self.byte()
        self.machine.stdin.write(b"+")
        self.machine.stdin.flush()
        return text.decode()

    def byte(self):
        byte = self.machine.stdout.read(1)
        if not byte:
            raise EOFError("the machine has ended")
        return byte

    def run_to(self, address):
        """Also from there to the next time."""
        for command in ("s", "Z1,%x,4" % address, "c", "z1,%x,4" % address):
            answer = self.ask(command)
            if answer != "OK" and not answer.startswith("T05"):
                raise EOFError(f"the program has ended ({answer})")

    def monitor(self, command):
        answer = self.ask("qRcmd," + command.encode().hex())
        while answer != "OK":
            answer = self.answer()

    def write_word(self, address, value):
        self.ask("M%x,4:%s" % (address, value.to_bytes(4, "little").hex()))

    def read_words(self, address, count):
        return struct.unpack("<%dI" % count, bytes.fromhex(self.ask("m%x,%x" % (address, 4 * count))))


def table(change):
    return bytes(change(value) & 255 for value in range(256))


# Bytes of RGB565 from colours whose lowest bits are 0; and such colours as a screen widens them, so that white is white.
LOW_OF_GREEN, LOW_OF_BLUE, HIGH_OF_GREEN = table(lambda v: v << 3 & 0xE0), table(lambda v: v >> 3), table(lambda v: v >> 5)
WIDE_5, WIDE_6 = table(lambda v: v | v >> 5), table(lambda v: v | v >> 6)


def both(a, b):
    return (int.from_bytes(a, "little") | int.from_bytes(b, "little")).to_bytes(len(a), "little")


def read_screenshot(path):
    """Width, height, and planes of red, green and blue. QEMU moves codes to the highest bits."""
    with open(path, "rb") as file:
        data = file.read()
    width, height = map(int, data.split(maxsplit=4)[1:3])
    rgb = data[-3 * width * height:]
    return width, height, rgb[0::3], rgb[1::3], rgb[2::3]


def rgb565(red, green, blue):
    codes = bytearray(2 * len(red))
    codes[0::2] = both(green.translate(LOW_OF_GREEN), blue.translate(LOW_OF_BLUE))
    codes[1::2] = both(red, green.translate(HIGH_OF_GREEN))
    return bytes(codes)


def write_widened(path, width, height, red, green, blue):
    rgb = bytearray(3 * width * height)
    rgb[0::3], rgb[1::3], rgb[2::3] = red.translate(WIDE_5), green.translate(WIDE_6), blue.translate(WIDE_5)
    with open(path, "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % (width, height) + rgb)


def hold(debugger, keys):
    """Pulls the pins of a mask of keys to ground, and no other."""
    low = sum(1 << pin for key, pin in PINS.items() if keys & key)
    debugger.write_word(SET_PINS, ~low & 0xFFFFFFFF)
    debugger.write_word(CLEAR_PINS, low)


class Screen:
    """What the firmware has been told, from the program's messages (board.h, display.c)."""

    def __init__(self, debugger, message, shot):
        self.debugger, self.message, self.shot = debugger, message, shot
        words = debugger.read_words(message, 30)
        self.width, self.height, self.base, self.pitch = words[5], words[6], words[23] & 0x3FFFFFFF, words[28]

    def page(self):
        """The rows that are shown, of RGB565."""
        top = self.debugger.read_words(self.message, 7)[6]
        self.debugger.monitor('pmemsave 0x%x %d "%s"' % (self.base + top * self.pitch, self.height * self.pitch, self.shot))
        with open(self.shot, "rb") as file:
            data = file.read()
        rows = b"".join(data[y * self.pitch:y * self.pitch + 2 * self.width] for y in range(self.height))
        if top == 0 and rows != rgb565(*self.screenshot()[2:]):
            raise EOFError("the screen does not show its first page")
        return rows

    def screenshot(self):
        self.debugger.monitor("screendump " + self.shot)
        picture = read_screenshot(self.shot)
        if picture[:2] != (self.width, self.height):
            raise EOFError(f"the screen is {picture[0]}x{picture[1]}")
        return picture


def watch(debugger, options, keys, symbols, shot):
    asks_keys = symbols["display_keys"]
    debugger.ask("Qqemu.PhyMemMode:1")
    hold(debugger, keys.get(0, 0))
    debugger.run_to(asks_keys)
    screen = Screen(debugger, symbols["board_message"], shot)
    if not options.shot:
        debugger.run_to(asks_keys)          # before the first frame
    for frame in range(options.frames):
        if frame in keys:
            hold(debugger, keys[frame])
        debugger.run_to(asks_keys)
        if not options.shot:
            print(frame, "%08x" % zlib.crc32(screen.page()), flush=True)
    if options.shot:
        write_widened(options.shot, *screen.screenshot())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--frames", type=int, default=1)
    parser.add_argument("--keys", default="")
    parser.add_argument("--shot")
    parser.add_argument("program")
    parser.add_argument("argument", nargs="*")
    options = parser.parse_args()
    keys = dict(map(int, pair.split(":")) for pair in options.keys.split(",") if pair)
    lines = subprocess.run(["arm-none-eabi-nm", options.program], capture_output=True, text=True, check=True).stdout.splitlines()
    symbols = {line.split()[2]: int(line.split()[0], 16) for line in lines}
    image = os.path.splitext(options.program)[0] + ".img"
    config = ",".join(["enable=on,target=native"] + ["arg=" + a for a in ["kernel"] + options.argument])
    debugger = Debugger(["qemu-system-arm", "-M", "raspi0", "-S", "-gdb", "stdio", "-display", "none", "-monitor", "none",
                         "-serial", "null", "-semihosting-config", config,
                         "-device", f"loader,file={image},addr=0x8000,force-raw=on,cpu-num=0"])
    with tempfile.TemporaryDirectory() as folder:
        try:
            watch(debugger, options, keys, symbols, os.path.join(folder, "screen"))
        except EOFError as error:
            print(f"watch.py: {options.program}: {error}", file=sys.stderr)
            return 1
        finally:
            debugger.machine.kill()
            debugger.machine.wait()
    return 0


sys.exit(main())
