"""The base of tests under mpirun. A run that waits for a rank that has gone never ends by itself: the time limit decides."""
import os
import subprocess

from program_test import DONE, ProgramTest, TIME_LIMIT

# Two cores must do for four ranks, and tests run as root in containers.
MPIRUN = ["mpirun", "--oversubscribe", "--bind-to", "none", "--quiet"]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_pml": "ob1"}  # other transports take 0.2 s to start


# After a rank has failed, mpirun ends the others at once. By default it waits for a second, which an interrupted run needs
# for its checkpoint.
WITHOUT_DELAY = {**ENVIRONMENT, "OMPI_MCA_odls_base_sigkill_timeout": "0"}


class RanksTest(ProgramTest):
    def command_on(self, n_ranks, *arguments):
        return [*MPIRUN, "-np", str(n_ranks), *self.command(arguments)]

    def start_ranks(self, command):
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True, cwd=self.scratch, env=WITHOUT_DELAY)
        self.addCleanup(self.end_ranks, process)
        return process

    def end_ranks(self, process):
        """mpirun ends its ranks when it is asked to; killed, it would leave them behind."""
        if process.poll() is None:
            process.terminate()
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                pass
        self.end_process(process)

    def finish_ranks(self, process, code, seconds=TIME_LIMIT):
        """What it said on standard output and standard error."""
        try:
            said, errors = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            self.end_ranks(process)
            self.fail(f"the ranks wait for each other: {' '.join(process.args)}")
        self.assertEqual(process.returncode, code, said + errors)
        return subprocess.CompletedProcess(process.args, process.returncode, said, errors)

    def run_on(self, n_ranks, *arguments, code=DONE, seconds=TIME_LIMIT):
        return self.finish_ranks(self.start_ranks(self.command_on(n_ranks, *arguments)), code, seconds)
