"""Looks at a live page without a browser: look.py ADDRESS reads what it sends until it ends, and
look.py ADDRESS N joins and leaves N times. Prints how often it got a frame."""
import os
import re
import socket
import sys
import time

REQUEST = ("GET /socket?token={token} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Protocol: jostle\r\nOrigin: http://{host}:{port}\r\n\r\n")


def parts(address):
    """Host, port and token of the address that the program prints."""
    return re.match(r"http://([^:/]+):(\d+)/\?token=(\S+)", address).groups()


def say(there, command):
    """A command as text, of at most 125 bytes, under a mask of zeros."""
    text = command.encode()
    there.sendall(bytes((0x81, 0x80 | len(text))) + bytes(4) + text)


def join(host, port, token):
    """A socket that has been sent the head of an answer and something more."""
    there = socket.create_connection((host, int(port)), timeout=20)
    there.sendall(REQUEST.format(host=host, port=port, token=token).encode())
    answer = b""
    while b"\r\n\r\n" not in answer or answer.endswith(b"\r\n\r\n"):
        some = there.recv(65536)
        if not some:
            raise ConnectionError(answer.decode(errors="replace"))
        answer += some
    if b" 101 " not in answer.split(b"\r\n")[0]:
        raise ConnectionError(answer.decode(errors="replace"))
    return there


def leave(there):
    """Says so, as browsers do: a frame that closes, under a mask of zeros. What was sent is read to its end:
    a socket that is closed with something unread is reset, and takes with it what the server has not read."""
    there.sendall(b"\x88\x80" + bytes(4))
    while there.recv(1 << 16):
        pass
    there.close()


def main():
    host, port, token = parts(sys.argv[1])
    seen = 0
    if len(sys.argv) > 2:
        for _ in range(int(sys.argv[2])):
            leave(join(host, port, token))
            seen += 1
    else:
        there = join(host, port, token)
        answered = time.monotonic()
        try:
            while there.recv(1 << 20):
                seen += 1
                if time.monotonic() - answered > 5:  # as to a ping: who is silent is taken for gone
                    there.sendall(b"\x8a\x80" + bytes(4))
                    answered = time.monotonic()
        except (TimeoutError, OSError):
            pass
    print(seen)
    os._exit(0 if seen else 1)


if __name__ == "__main__":
    main()
