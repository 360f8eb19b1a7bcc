/* SPDX-License-Identifier: MIT */
/* semihost.c - semihosting calls: the operation in the first register, its argument or a block of them
 * in the second, the result in the first. "Semihosting for AArch32 and AArch64", Arm, release 2.0;
 * "RISC-V Semihosting", RISC-V International. */
#include "platform/common/semihost.h"

enum {
    SYS_OPEN = 0x01,
    SYS_CLOSE = 0x02,
    SYS_WRITE0 = 0x04,
    SYS_WRITE = 0x05,
    SYS_READ = 0x06,
    SYS_GET_CMDLINE = 0x15,
    SYS_EXIT_EXTENDED = 0x20
};

#define APPLICATION_EXIT 0x20026u

#if defined(__riscv)
/* Three instructions of four bytes on one page. */
static __attribute__((noinline)) uint32_t call(uint32_t operation, const void *argument)
{
    register uint32_t a0 __asm("a0") = operation;
    register const void *a1 __asm("a1") = argument;
    __asm volatile(".balign 16\n\t.option push\n\t.option norvc\n\t"
                   "slli x0, x0, 0x1f\n\tebreak\n\tsrai x0, x0, 7\n\t.option pop"
                   : "+r"(a0) : "r"(a1) : "memory");
    return a0;
}
#elif defined(__ARM_ARCH_ISA_ARM)
/* In supervisor mode the call overwrites the link register. */
static uint32_t call(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm("r0") = operation;
    register const void *r1 __asm("r1") = argument;
    __asm volatile("svc 0x123456" : "+r"(r0) : "r"(r1) : "lr", "memory");
    return r0;
}
#else
static uint32_t call(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm("r0") = operation;
    register const void *r1 __asm("r1") = argument;
    __asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}
#endif

static uint32_t length_of(const char *text)
{
    uint32_t length = 0;
    while (text[length] != '\0')
        length++;
    return length;
}

void semihost_print(const char *text)
{
    call(SYS_WRITE0, text);
}

_Noreturn void semihost_exit(int status)
{
    const uint32_t block[2] = { APPLICATION_EXIT, (uint32_t)status };
    call(SYS_EXIT_EXTENDED, block);
    for (;;) {
    }
}

int semihost_command_line(char *text, size_t room)
{
    uint32_t block[2] = { (uint32_t)text, (uint32_t)room };
    return call(SYS_GET_CMDLINE, block) == 0;
}

int semihost_open(const char *path, int mode)
{
    const uint32_t block[3] = { (uint32_t)path, (uint32_t)mode, length_of(path) };
    return (int)call(SYS_OPEN, block);
}

uint32_t semihost_write(int file, const void *bytes, uint32_t count)
{
    const uint32_t block[3] = { (uint32_t)file, (uint32_t)bytes, count };
    return call(SYS_WRITE, block);
}

uint32_t semihost_read(int file, void *bytes, uint32_t count)
{
    const uint32_t block[3] = { (uint32_t)file, (uint32_t)bytes, count };
    return call(SYS_READ, block);
}

int semihost_close(int file)
{
    const uint32_t block[1] = { (uint32_t)file };
    return (int)call(SYS_CLOSE, block);
}
