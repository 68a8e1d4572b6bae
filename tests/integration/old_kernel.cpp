// old_kernel LAST PROGRAM [ARGUMENTS]: runs PROGRAM as on a kernel whose last system call has the
// number LAST: every newer one is answered with ENOSYS. What the calls that are left do, and what
// /proc says, is still this kernel's.
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <system_error>
#include <unistd.h>

namespace {

#if defined(__i386__)
constexpr unsigned architecture = AUDIT_ARCH_I386;
#else
constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#endif

// For this process and what it executes.
bool refuse_calls_after(unsigned last) {
  constexpr unsigned short load = BPF_LD | BPF_W | BPF_ABS;
  constexpr unsigned short jump_if_equal = BPF_JMP | BPF_JEQ | BPF_K;
  constexpr unsigned short jump_if_greater = BPF_JMP | BPF_JGT | BPF_K;
  constexpr unsigned short answer = BPF_RET | BPF_K;
  sock_filter instructions[] = {
      {load, 0, 0, offsetof(seccomp_data, arch)}, {jump_if_equal, 1, 0, architecture},
      {answer, 0, 0, SECCOMP_RET_KILL_PROCESS},  // another architecture numbers its calls otherwise
      {load, 0, 0, offsetof(seccomp_data, nr)},   {jump_if_greater, 0, 1, last},
      {answer, 0, 0, SECCOMP_RET_ERRNO | ENOSYS}, {answer, 0, 0, SECCOMP_RET_ALLOW},
  };
  const sock_fprog program{sizeof instructions / sizeof *instructions, instructions};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  unsigned last = 0;
  if (argc < 3 ||
      std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), last).ec != std::errc{}) {
    std::fputs("old_kernel LAST PROGRAM [ARGUMENTS]\n", stderr);
    return 2;
  }
  if (!refuse_calls_after(last)) {
    std::perror("old_kernel: seccomp");
    return 3;
  }
  execv(argv[2], argv + 2);
  std::perror(argv[2]);
  return 4;
}
